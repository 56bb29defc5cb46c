//! Volumes that share a series: phases, echoes, acquisitions, as they were put together.

use super::*;

/// Two volumes of one series, the second ten higher: `change` makes slice `k` of each.
fn two(change: impl Fn(usize, usize, File) -> File) -> Files {
    let slices = [2, 0, 3, 1].into_iter().flat_map(|k| [(1, k), (0, k)]);
    slices.map(|(volume, k)| ("a", change(volume, k, shifted(volume, k)).bytes())).collect()
}

/// Slice `k`, with values higher by ten for each volume before it, and a number that says nothing.
fn shifted(volume: usize, k: usize) -> File {
    let slice =
        File::slice(EXPLICIT, k).with(0x0020, 0x0013, text(["1", "8", "4", "7", "2", "3", "6", "5"][4 * volume + k]));
    let pixels = slice.elements.last().unwrap().3.as_chunks::<2>().0.iter();
    let pixels = pixels.flat_map(|&pixel| (u16::from_le_bytes(pixel) + 20 * volume as u16).to_le_bytes()).collect();
    slice.with(0x7FE0, 0x0010, pixels)
}

#[test]
fn a_volume_that_nothing_tells_apart_leaves_the_others_to_be_opened() {
    let mixed = |file: File| file.with(0x0020, 0x000E, text("1.2.3.9")).without(0x0020, 0x0013);
    let mut files = two(|_, _, file| mixed(file));
    files.extend(series(EXPLICIT).into_iter().take(3));
    let scan = open(&files).unwrap();
    let told = in_english(&scan.warnings).join(" ");
    assert!(scan.grid.geometry().size[2] == 3 && told.contains("1 volume is left out: several"), "{told}");
    assert_eq!(open_volume(&files, Some(0)).unwrap_err(), ScanError::Mixed { places: 4 });
    // Pixels that are not read are the reason, where they are.
    let unread = two(|_, _, file| File { syntax: BASELINE, ..mixed(file) });
    let told = open(&unread).unwrap_err().to_string();
    assert!(!told.contains("Several slices"), "{told}");
}

/// How each is told apart, and by what: the two volumes are known, as they were put together.
#[test]
fn two_volumes_of_a_series_are_told_apart_and_never_mixed() {
    let moment = |volume: usize, k: usize| text(&format!("1200{:02}.{}", 20 * volume + k, 9 - k));
    let ways: [(VolumeField, Files); 11] = [
        (VolumeField::Time, two(|volume, _, file| file.also(0x0020, 0x0100, "IS", text(&(volume + 1).to_string())))),
        (
            VolumeField::Acquisition,
            two(|volume, _, file| file.also(0x0020, 0x0012, "IS", text(&(volume + 3).to_string()))),
        ),
        (VolumeField::Echo, two(|volume, _, file| file.also(0x0018, 0x0081, "DS", text(["2.5", "12"][volume])))),
        (
            VolumeField::ImageType,
            two(|volume, _, file| file.also(0x0008, 0x0008, "CS", text(["A\\B\\M", "A\\B\\P"][volume]))),
        ),
        // The times of a heart are never quite the same.
        (
            VolumeField::Trigger,
            two(|volume, k, file| {
                file.also(0x0018, 0x1060, "DS", text(&format!("{}", 400 * volume + [3, 1, 0, 2][k])))
            }),
        ),
        (VolumeField::Moment, two(|volume, k, file| file.also(0x0008, 0x0033, "TM", moment(volume, k)))),
        (VolumeField::Order, two(|volume, k, file| file.with(0x0020, 0x0013, text(&(4 * volume + k).to_string())))),
        (VolumeField::Order, two(|volume, k, file| file.with(0x0020, 0x0013, text(&(volume + 2 * k).to_string())))),
        // Beside each other.
        (
            VolumeField::Acquisition,
            two(|volume, k, file| {
                file.also(0x0020, 0x0012, "IS", text(&volume.to_string())).with(
                    0x0020,
                    0x0032,
                    place(k, 0.7 * volume as f64),
                )
            }),
        ),
        (
            VolumeField::Moment,
            two(|volume, k, file| {
                let file = file.also(0x0008, 0x0032, "TM", moment(volume, k));
                file.with(0x0020, 0x0032, place(k, 0.7 * volume as f64))
            }),
        ),
        (VolumeField::Place, {
            let more = |k, up| ("a", File::slice(EXPLICIT, k % 4).with(0x0020, 0x0032, place(k, up)).bytes());
            (0..4).flat_map(|k| [more(k, 0.0), more(k, 0.7)]).collect()
        }),
    ];
    for (number, (field, files)) in ways.iter().enumerate() {
        let scan = open_volume(files, None).unwrap_or_else(|error| panic!("{number}, {field}: {error}"));
        assert_is_it(&scan, &format!("{number}, {field}"));
        let told: Vec<_> = scan.offers.iter().map(|offer| (offer.by, offer.slices)).collect();
        assert_eq!((told, scan.taken), (vec![(Some(*field), 4); 2], 0), "{number}");
        let said = in_english(&scan.warnings);
        assert!(
            said.len() == 1 && said[0].contains(&format!("2 volumes of one series, told apart by {field}")),
            "{said:?}"
        );
        let second = open_volume(files, Some(1)).unwrap();
        assert!(second.warnings.is_empty(), "{:?}", second.warnings);
        if *field != VolumeField::Place {
            assert!(
                points().all(|point| second.grid.value(point) == f64::from(value(point)) + 10.0),
                "{number}, {field}"
            );
        }
        assert_eq!(open_volume(files, Some(2)), Err(ScanError::NoSuchVolume { number: 3, count: 2 }));
    }
    let mixed = open_volume(&two(|_, _, file| file), None).unwrap_err();
    assert_eq!(mixed, ScanError::Mixed { places: 4 });
}

#[test]
fn volumes_of_two_fields_are_told_apart() {
    let slices = (0..16).map(|n| {
        let file = shifted(0, n % 4).with(0x0020, 0x0013, text("1"));
        let (echo, time) = (n / 4 % 2, n / 8);
        let file = file.also(0x0018, 0x0086, "IS", text(&echo.to_string())).also(
            0x0020,
            0x0100,
            "IS",
            text(&time.to_string()),
        );
        // Of each another value, so that no two are the same slice.
        ("a", file.with(0x0028, 0x1052, text(&(echo + 2 * time).to_string())).bytes())
    });
    let scan = open_volume(&slices.collect(), Some(2)).unwrap();
    let values: Vec<_> = scan.offers.iter().map(|offer| offer.value.as_str()).collect();
    assert_eq!(values, ["0, 0", "0, 1", "1, 0", "1, 1"]);
    assert!(points().all(|point| scan.grid.value(point) == f64::from(value(point)) + 1002.0));
}

/// Times and acquisitions that differ from slice to slice, or from every other one to the next, of one volume.
#[test]
fn fields_that_differ_within_a_volume_do_not_take_it_apart() {
    let one = |change: &dyn Fn(usize, File) -> File| {
        let files: Files = (0..4).map(|k| ("a", change(k, File::slice(EXPLICIT, k)).bytes())).collect();
        let scan = open(&files).unwrap();
        assert_is_it(&scan, "one volume");
        assert!(scan.warnings.is_empty() && scan.offers.len() == 1, "{:?}", scan.warnings);
    };
    one(&|k, file| file.also(0x0008, 0x0033, "TM", text(&format!("12000{k}"))));
    one(&|k, file| {
        file.also(0x0020, 0x0012, "IS", text(&k.to_string())).also(0x0008, 0x0032, "TM", text(&format!("12000{k}")))
    });
    one(&|k, file| file.also(0x0008, 0x0032, "TM", text(&format!("12000{}", k % 2))));
    one(&|k, file| file.also(0x0018, 0x1060, "DS", text(&format!("{}", 7 * k))));
}
