//! The embeddable FIL runtime and post-processor.
