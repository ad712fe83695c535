//! Offline: the semi-inverse nominal half-step.
