#![no_main]
//! The reader of VTK.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lumen_fuzz::survives(bytes, "a.vtk"));
