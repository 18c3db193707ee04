use std::fmt;

use super::Generated;

/// Arithmetic of a straight-line function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications and divisions.
    pub multiplications: usize,
}

/// A factor of a product: folded while generating where it is known.
#[derive(Clone, Debug)]
pub(super) enum Factor {
    Constant(f64),
    /// A name or an element `a[i]`.
    Named(String),
}

impl fmt::Display for Factor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // The shortest text that reads back as the same f32.
            Self::Constant(value) => write!(f, "{:?}", *value as f32),
            Self::Named(name) => f.write_str(name),
        }
    }
}

impl Factor {
    pub(super) fn named(name: impl Into<String>) -> Self {
        Self::Named(name.into())
    }

    pub(super) fn element(array: &str, position: usize) -> Self {
        Self::Named(format!("{array}[{position}]"))
    }
}

/// Their product: one constant at most, ones left out. It binds more tightly than a sum.
pub(super) fn product(factors: &[&Factor]) -> Factor {
    let mut constant = 1.0;
    let mut names = Vec::new();
    for factor in factors {
        match factor {
            Factor::Constant(value) => constant *= value,
            Factor::Named(name) => names.push(name.clone()),
        }
    }
    if names.is_empty() {
        return Factor::Constant(constant);
    }
    if constant != 1.0 {
        names.insert(0, Factor::Constant(constant).to_string());
    }
    Factor::Named(names.join(" * "))
}

/// The sum of products with their signs; `0.0` where there are none.
pub(super) fn sum(terms: impl IntoIterator<Item = (bool, Factor)>) -> String {
    let mut text = String::new();
    for (positive, term) in terms {
        match (text.is_empty(), positive) {
            (true, true) => {}
            (true, false) => text.push('-'),
            (false, true) => text.push_str(" + "),
            (false, false) => text.push_str(" - "),
        }
        text.push_str(&term.to_string());
    }
    if text.is_empty() { "0.0".to_owned() } else { text }
}

/// The body of a function, line by line.
#[derive(Default)]
pub(super) struct Lines {
    text: String,
}

impl Lines {
    /// `let name = expression;`
    pub(super) fn bind(&mut self, name: &str, expression: impl fmt::Display) -> Factor {
        self.text.push_str(&format!("    let {name} = {expression};\n"));
        Factor::named(name)
    }

    /// `name: array<vec3f, length>`, for [`Self::add`].
    pub(super) fn sums(&mut self, name: &str, length: usize) {
        self.text.push_str(&format!("    var {name}: array<vec3f, {length}>;\n"));
    }

    /// `name[position] += expression;`
    pub(super) fn add(&mut self, name: &str, position: usize, expression: impl fmt::Display) {
        self.text.push_str(&format!("    {name}[{position}] += {expression};\n"));
    }

    /// `return expression;`
    pub(super) fn give(mut self, expression: impl fmt::Display) -> Self {
        self.text.push_str(&format!("    return {expression};\n"));
        self
    }

    /// `return array<element, …>(values);`, one value a line.
    pub(super) fn give_array(self, element: &str, values: &[String]) -> Self {
        let list = values.join(",\n        ");
        self.give(format_args!("array<{element}, {}>(\n        {list},\n    )", values.len()))
    }

    /// The whole declaration, its operators counted: binary ones alone stand between spaces.
    pub(super) fn function(self, signature: &str) -> Generated {
        let count = |operators: &[&str]| -> usize {
            operators.iter().map(|operator| self.text.matches(operator).count()).sum()
        };
        let operations = Operations {
            additions: count(&[" + ", " += ", " - "]),
            multiplications: count(&[" * ", " / "]),
        };
        Generated { wgsl: format!("fn {signature} {{\n{}}}\n", self.text), operations }
    }
}
