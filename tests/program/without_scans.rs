//! A build without the readers of scans, and without the window: what is asked of these is refused by the feature's name.

use crate::program::{Folder, lumen, succeed};

const NO_SCANS: &str = "this build was made without scans and masks (feature scans)";

/// What a command that fails says.
fn refused(arguments: &[&str]) -> String {
    let output = lumen(arguments);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn scans_are_refused_by_the_feature_that_is_missing() {
    let folder = Folder::new("without-scans");
    let nifti = [&[0; 344][..], b"n+1\0", &[0; 100]].concat();
    let dicom = [&[0; 128][..], b"DICM", &[0; 100]].concat();
    let image = b"<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\"></VTKFile>";
    for (name, bytes) in [
        ("a.nii", &nifti[..]),
        ("a.nii.gz", b"\x1f\x8b\x08"),
        ("a.dcm", &dicom),
        ("a.nrrd", b"NRRD0004\n"),
        ("a.vti", image),
        ("a.mhd", b"NDims = 3\nDimSize = 2 2 2\n"),
    ] {
        let (scan, out) = (folder.file(name), folder.file("out.ply"));
        std::fs::write(&scan, bytes).unwrap();
        for arguments in
            [&["inspect", &scan][..], &["mend", &scan, "-o", &out, "--split"], &["inspect", &scan, "--label", "1"]]
        {
            assert_eq!(refused(arguments), format!("lumen: {scan}: {NO_SCANS}\n"), "{arguments:?}");
        }
        assert_eq!(refused(&["surface", &scan, "-o", &out, "--threshold", "150"]), format!("lumen: {NO_SCANS}\n"));
    }
    let inner = folder.file("series");
    std::fs::create_dir_all(&inner).unwrap();
    assert_eq!(refused(&["inspect", &inner]), format!("lumen: {inner}: {NO_SCANS}\n"));
    assert!(succeed(&["--help"]).contains("Write the surface in a scan or a mask"));
}

#[cfg(not(feature = "gui"))]
#[test]
fn the_window_and_figures_are_refused_by_the_feature_that_is_missing() {
    assert_eq!(
        refused(&["figures", "sample:aorta", "-o", "a", "--width", "600"]),
        "lumen: this build has nothing to draw with (feature gui)\n"
    );
    assert!(succeed(&["--help"]).contains("figures"));
    let output = lumen(&["a.stl"]);
    assert!(String::from_utf8(output.stderr).unwrap().contains("without the window (feature gui)"));
}
