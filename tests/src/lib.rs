//! The tests of this package lie in `tests/`.
