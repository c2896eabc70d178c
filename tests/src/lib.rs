//! Support for the test runners of this member.
