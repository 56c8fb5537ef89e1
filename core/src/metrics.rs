//! The error of one image against another.
