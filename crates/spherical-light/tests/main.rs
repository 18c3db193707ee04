//! Shading by spherical lights.
