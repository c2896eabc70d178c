//! FIL compiler and virtual machine.
