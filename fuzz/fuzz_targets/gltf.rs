#![no_main]
//! The reader of glTF and GLB.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lumen_fuzz::survives(bytes, "a.gltf"));
