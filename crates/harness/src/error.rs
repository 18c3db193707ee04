//! How the program ends when it does not end well.

use manylights_method as method;

/// What ends a command early. The text is one line: what, where, how to mend it.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The user can mend it: exit status 2.
    #[error("{0}")]
    BadInput(String),
    /// A comparison failed: exit status 1.
    #[error("{0}")]
    Failed(String),
}

impl Failure {
    /// Bad input, from anything that can be read.
    pub(crate) fn input(reason: impl ToString) -> Self {
        Self::BadInput(one_line(&reason.to_string()))
    }

    /// The exit status of the contract.
    pub fn status(&self) -> u8 {
        match self {
            Self::Failed(_) => 1,
            Self::BadInput(_) => 2,
        }
    }
}

impl From<method::Error> for Failure {
    fn from(error: method::Error) -> Self {
        match error {
            method::Error::Declined(reason) => Self::input(reason),
            method::Error::Failed(reason) => Self::Failed(one_line(&reason)),
        }
    }
}

/// Errors of libraries may span lines; the contract promises one.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_carry_their_exit_status_and_one_line() {
        let failure = Failure::input("first\n  second");
        assert_eq!((failure.status(), failure.to_string().as_str()), (2, "first second"));
        assert_eq!(Failure::from(method::Error::Failed("lost".into())).status(), 1);
        assert_eq!(Failure::from(method::Error::Declined("no".into())).status(), 2);
    }
}
