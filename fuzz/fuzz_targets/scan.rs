#![no_main]
//! The readers of scans: NIfTI, NRRD, MetaImage, VTI, DICOM.

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lumen_fuzz::survives_as_scan(bytes));
