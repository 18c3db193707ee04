use crate::LoadError;

/// What is found wrong at `place` (a path into the JSON) in a file that nothing here can mend.
pub(super) fn broken(place: impl std::fmt::Display, problem: impl std::fmt::Display) -> LoadError {
    LoadError::new(place, problem, "repair the file or export it again")
}
