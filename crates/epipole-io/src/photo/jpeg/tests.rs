//! Files of 45 × 37 pixels, as `libjpeg` writes them with tables of their own, and damaged
//! variants.

use super::check::{Missing, check};
use crate::photo::{DecodeOptions, decode_rgb};
use crate::shared;
use image::RgbImage;

/// In one scan.
const SEQUENTIAL: &str = "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a181616\
     183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c656763ff\
     db0043011112121815182f1a1a2f63423842636363636363636363636363636363636363636363636363636363\
     6363636363636363636363636363636363636363636363ffc00011080025002d03012200021101031101ffc400\
     1800010101010100000000000000000000000300040206ffc40024100001040202020105000000000000000001\
     000203112141315161719112325281c1ffc4001801000301010000000000000000000000000203040106ffc400\
     1a110003010101010000000000000000000000010302112112ffda000c03010002110311003f00f1ac8efc692b\
     6103e1698e2d9183e12086f35c7029626b9d60cea03631c75b4a221f88ae395a0478e081e92086862e8f485e91\
     7ce86711dd9031bc26110e2bde93b621791490461c3ed18eca5bd22f9d0c6d8cd0144ff1288f0718d276c46850\
     cf3491b1600f283efc3919d026b0e8246c24e93322ac702b695b1f7412decbe7401911cea86b49046eac034b40\
     8f249012b19438bfda4bd97ce86263057a0958c05c47454a5bdf0e566cedad6f47ae52b583eaaf34a52569b2f9\
     b1830023779ca66c62b81f0a525e9b45f367ffd9";

/// In one scan with a restart after every other unit.
const RESTARTS: &str = "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a181616\
     183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c656763ff\
     db0043011112121815182f1a1a2f63423842636363636363636363636363636363636363636363636363636363\
     6363636363636363636363636363636363636363636363ffc00011080025002d03012200021101031101ffc400\
     190001010101010100000000000000000000030004020506ffc400241000010402020201050000000000000000\
     01000203112141315161719112325281c1ffc4001a010003010003000000000000000000000002040503000106\
     ffc4001a110003010101010000000000000000000000010302112112ffdd00040002ffda000c03010002110311\
     003f00f8d6477e3495b081f0b4c716c8c1f0904379ae3814ba4d73ac19d406c638eb694443f115c72b408f1c10\
     3d2410d0c5d1e90bd21f9d0fffd0f04477640c6f0984438af7a4ed885e452411870fb463b2b07a45c9d0c6d8cd\
     0144ff001288f0718d276c46850cf3491b1600f283efc3c8ce87ffd1c2d61d048d849d2664558e056d2b63ee82\
     45ec09d0064473aa1ad2411bab00d2d023c92404ac650e2ff6b17b1f9d0fffd2e58c15e8256301711d15294cef\
     8419b3b6b5bd1eb94ad60faabcd294b2d363f367ffd3f4430023779ca66c62b81f0a5287a6d1c9b3ffd9";

/// In ten scans, of all kinds.
const PROGRESSIVE: &str = "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a181616\
     183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c656763ff\
     db0043011112121815182f1a1a2f63423842636363636363636363636363636363636363636363636363636363\
     6363636363636363636363636363636363636363636363ffc20011080025002d03012200021101031101ffc400\
     17000101010100000000000000000000000002030005ffc4001901000203010000000000000000000000000102\
     03040500ffda000c03010002100310000001e32aa026e884f36d2d88b686414d2ce1512588adbb292d9676f65b\
     1fffc4001810010101010100000000000000000000001100011020ffda0008010100010502222222cc8888888e\
     11111111ecbfffc4001511010100000000000000000000000000000200ffda0008010301013f012a2a2a2a2a2a\
     318dffc40017110101010100000000000000000000000000110110ffda0008010201013f0155555e6b5fffc400\
     14100100000000000000000000000000000040ffda0008010100063f0277ffc4001b1001010003000300000000\
     0000000000000100101121204171ffda0008010100013f212149f1e6149d7a8c01149b44210c01041d8083b6a2\
     7fffda000c030100020003000000104a33ac14479df3ffc4001611010101000000000000000000000000000001\
     20ffda0008010301013f10d2005294ffc4001811010101010100000000000000000000000100112131ffda0008\
     010201013f1013359122f335bbc9324bffc4001f10010002030100030101000000000000000100112131415161\
     719181c1ffda0008010100013f10bbe3900fc81af3b03e2b5b85ad0c77103aafbe4ea987e216cd6b45430d21f5\
     0a18ba7c83792a00698f589414bfe430718e45e111e47cf28e7214606a2d1467753087ccaf1a2bb3d28864a84a\
     cd5ff61d7d10d478cf03e6e0e1f3502276f39815a3f27fffd9";

fn file(hex: &str) -> Vec<u8> {
    let digit = |k: usize| u8::from_str_radix(&hex[k..k + 2], 16).unwrap();
    (0..hex.len()).step_by(2).map(digit).collect()
}

/// Returns the offset of the first scan's data.
fn data_at(file: &[u8]) -> usize {
    let scan = file.windows(2).position(|two| two == [0xFF, 0xDA]).unwrap();
    scan + 2 + usize::from(file[scan + 3])
}

fn check_all(file: &[u8]) -> Result<Missing, String> {
    check(file, u64::MAX)
}

const END: [u8; 2] = [0xFF, 0xD9];

#[test]
fn sound_files_pass() {
    for hex in [SEQUENTIAL, RESTARTS, PROGRESSIVE] {
        assert_eq!(check_all(&file(hex)), Ok(Missing::default()));
    }
}

#[test]
fn data_that_end_early_are_found_wherever_they_end() {
    for hex in [SEQUENTIAL, RESTARTS] {
        let whole = file(hex);
        let mut before = 0;
        for at in data_at(&whole)..whole.len() - 2 {
            let error = check_all(&[&whole[..at], &END].concat()).unwrap_err();
            let rows = error.strip_prefix("the JPEG file is damaged: its data end after ");
            let row = rows.and_then(|rest| rest.strip_suffix(" of 37 rows"));
            let row: u32 = row.unwrap_or_else(|| panic!("{error}")).parse().unwrap();
            assert!(row >= before, "{error}");
            before = row;
            // And without the marker.
            assert!(check_all(&whole[..at]).is_err());
        }
        assert_eq!(before, 32);
    }
    let whole = file(PROGRESSIVE);
    let mut passed = 0;
    for at in data_at(&whole)..whole.len() - 2 {
        passed += usize::from(check_all(&[&whole[..at], &END].concat()).is_ok());
        assert!(check_all(&whole[..at]).is_err());
    }
    // A file without its last scan is still an image, and tables may precede the scan.
    assert!(passed < 600, "{passed}");
}

#[test]
fn what_is_missing_in_the_middle_is_found() {
    for hex in [SEQUENTIAL, RESTARTS, PROGRESSIVE] {
        let whole = file(hex);
        let at = data_at(&whole);
        let (mut found, mut tried) = (0, 0);
        for from in at..whole.len() - 40 {
            let hole = [&whole[..from], &whole[from + 30..]].concat();
            found += u32::from(check_all(&hole).is_err());
            tried += 1;
        }
        // In an image this small, many scans of a progressive file are shorter than the part cut
        // out.
        let max_ratio = if hex == PROGRESSIVE { 5 } else { 9 };
        assert!(found * 10 > tried * max_ratio, "{found} of {tried}");
    }
}

#[test]
fn more_blocks_than_the_picture_has_are_found() {
    let mut whole = file(SEQUENTIAL);
    let frame = whole
        .windows(2)
        .position(|two| two == [0xFF, 0xC0])
        .unwrap();
    assert_eq!(whole[frame + 6], 37);
    whole[frame + 6] = 30;
    let error = check_all(&whole).unwrap_err();
    assert!(
        error.ends_with("its data are for more than 30 rows"),
        "{error}"
    );
}

#[test]
fn bytes_that_changed_are_found_where_they_make_no_sense() {
    let whole = file(SEQUENTIAL);
    let (mut senseless, mut found, mut tried) = (0, 0, 0);
    for at in data_at(&whole)..whole.len() - 2 {
        for mask in [0x01, 0x10, 0x55, 0xFF] {
            let mut changed = whole.clone();
            changed[at] ^= mask;
            if let Err(error) = check_all(&changed) {
                found += 1;
                senseless += u32::from(error.contains("make no sense after "));
            }
            tried += 1;
        }
    }
    // Tables optimized for this image leave hardly any code unused; in photos half of the changes
    // are found.
    assert!(senseless > 20, "{senseless}");
    assert!(found * 5 > tried, "{found} of {tried}");
}

#[test]
fn what_does_no_harm_is_no_damage() {
    let options = DecodeOptions::default();
    for hex in [SEQUENTIAL, RESTARTS, PROGRESSIVE] {
        let whole = file(hex);
        let picture = decode_rgb(&whole, &options).unwrap().image;
        let body = &whole[..whole.len() - 2];
        let junk: Vec<u8> = (0..18).map(|k| k * 11 + 3).collect();
        let mut unusual = vec![
            // Extra data after the image: another image, as some cameras write, or anything.
            [&whole[..], &whole].concat(),
            [&whole[..], &junk].concat(),
            // Before the last marker.
            [body, &junk, &END].concat(),
            [body, &[0; 18], &END].concat(),
            [body, &[0xFF; 5], &END].concat(),
            // Between the parts of the header.
            [&whole[..20], &[0; 7], &whole[20..]].concat(),
        ];
        if hex != PROGRESSIVE {
            unusual.push(body.to_vec());
            unusual.push([body, &[0xFF]].concat());
            unusual.push([body, &[0xFF, 0xE1, 0x10, 0x00, 0x12]].concat());
        }
        for (k, file) in unusual.iter().enumerate() {
            let decoded = decode_rgb(file, &options);
            assert!(decoded.is_ok_and(|d| d.image == picture), "{k}");
        }
    }
}

#[test]
fn what_is_unknown_is_left_to_the_decoder() {
    // Arithmetic coding, and a file larger than the limit.
    let mut whole = file(SEQUENTIAL);
    let at = data_at(&whole);
    whole.drain(at + 60..whole.len() - 2);
    assert!(check_all(&whole).is_err());
    assert_eq!(check(&whole, 45 * 37 - 1), Ok(Missing::default()));
    let frame = whole
        .windows(2)
        .position(|two| two == [0xFF, 0xC0])
        .unwrap();
    whole[frame + 1] = 0xC9;
    assert_eq!(check_all(&whole), Ok(Missing::default()));
}

/// Removes the segments of tables.
fn without_tables(file: &[u8]) -> Vec<u8> {
    let mut bare = file[..2].to_vec();
    let mut at = 2;
    while file[at + 1] != 0xDA {
        let length = usize::from(u16::from_be_bytes([file[at + 2], file[at + 3]]));
        if file[at + 1] != 0xC4 {
            bare.extend(&file[at..at + 2 + length]);
        }
        at += 2 + length;
    }
    bare.extend(&file[at..]);
    bare
}

#[test]
fn a_file_without_tables_is_read_by_the_standard_ones() {
    let picture = RgbImage::from_fn(45, 37, |u, v| {
        image::Rgb([(u * 5) as u8, (v * 6) as u8, ((u * v) % 251) as u8])
    });
    // The encoder writes the standard tables.
    let mut whole = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut whole, 95);
    picture.write_with_encoder(encoder).unwrap();
    let bare = without_tables(&whole);
    assert_eq!(bare.len() + 420 + 3 * 4, whole.len());
    let options = DecodeOptions::default();
    let expected = decode_rgb(&whole, &options).unwrap().image;
    for file in [&bare[..], &bare[..bare.len() - 2]] {
        assert!(check_all(file).unwrap().tables);
        assert_eq!(decode_rgb(file, &options).unwrap().image, expected);
    }
    // Data coded with other tables are invalid.
    assert!(check_all(&without_tables(&self::file(SEQUENTIAL))).is_err());
    // Progressive files always have their own.
    let progressive = check_all(&without_tables(&self::file(PROGRESSIVE)));
    assert!(progressive.is_ok_and(|missing| !missing.tables));
}

#[test]
fn a_frame_of_a_webcam_is_read() {
    let Some(path) = shared::field("28/mjpeg_no_dht.jpg") else {
        return;
    };
    let image = decode_rgb(&std::fs::read(path).unwrap(), &DecodeOptions::default());
    assert!(image.unwrap().image.pixels().any(|pixel| pixel.0[0] > 128));
}
