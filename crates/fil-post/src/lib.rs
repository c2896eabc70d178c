//! The generalized post: CL records to NC blocks.
