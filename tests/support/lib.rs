//! What several statements share.
