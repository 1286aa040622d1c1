use std::{fs, io::Cursor};

use ::exr::{
    image::{FlatImage, write::layers::WritableLayers},
    prelude::{
        AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image as ExrImage, ImageAttributes,
        IntegerBounds, Layer, LayerAttributes, LineOrder, SmallVec, SpecificChannels, Vec2, WritableImage, f16,
    },
};
use ::image::codecs::hdr::HdrEncoder;
use proptest::prelude::*;

use super::*;
use crate::Rgb;

const COMPRESSIONS: [Compression; 8] = [
    Compression::Uncompressed,
    Compression::RLE,
    Compression::ZIP1,
    Compression::ZIP16,
    Compression::PIZ,
    Compression::PXR24,
    Compression::B44,
    Compression::DWAA(None),
];

/// Values that eight bits of mantissa hold exactly.
fn sample() -> Image {
    let pixel = |i: usize| Rgb([(i % 12) as f32 / 4.0, 2.0, 0.5 + (i / 12) as f32]);
    Image::new(12, 6, (0..72).map(pixel).collect())
}

fn hdr(image: &Image) -> Vec<u8> {
    let pixels: Vec<_> = image.pixels().iter().map(|pixel| ::image::Rgb(pixel.0)).collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, image.width(), image.height()).unwrap();
    bytes
}

/// Red, green, blue and alpha, 16 bits each.
fn exr(image: &Image, compression: Compression) -> Vec<u8> {
    let (size, image) = ((image.width(), image.height()), image.clone());
    let pixel = move |at: Vec2<usize>| {
        let [red, green, blue] = image.get(at.x(), at.y()).0.map(f16::from_f32);
        (red, green, blue, f16::ONE)
    };
    let blocks = if compression == Compression::ZIP1 { Blocks::Tiles(Vec2(5, 4)) } else { Blocks::ScanLines };
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let channels = SpecificChannels::rgba(pixel);
    written(&ExrImage::from_encoded_channels(size, encoding, channels))
}

fn written<L: for<'a> WritableLayers<'a>>(image: &ExrImage<L>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn layers(of: &[(&str, &[&str])]) -> Vec<u8> {
    let layer = |&(name, channels): &(&str, &[&str])| {
        let channel = |&name: &&str| AnyChannel::new(name, FlatSamples::F32(vec![1.0; 2]));
        let channels: SmallVec<_> = channels.iter().map(channel).collect();
        Layer::new((2, 1), LayerAttributes::named(name), Encoding::UNCOMPRESSED, AnyChannels::sort(channels))
    };
    let layers: SmallVec<_> = of.iter().map(layer).collect();
    written(&FlatImage::from_layers(ImageAttributes::new(IntegerBounds::from_dimensions((2, 1))), layers))
}

fn read(bytes: &[u8]) -> Result<Image, ImageReadProblem> {
    Image::parse(bytes)
}

#[test]
fn a_radiance_picture_is_read_as_written() {
    assert_eq!(read(&hdr(&sample())).unwrap(), sample());
}

#[test]
fn an_openexr_picture_of_half_floats_is_read_as_written() {
    let sample = sample();
    for compression in COMPRESSIONS {
        let found = read(&exr(&sample, compression)).unwrap();
        let errors = found.pixels().iter().zip(sample.pixels()).map(|(&a, &b)| a.zip(b, |a, b| (a - b).abs()).max());
        let lossy = matches!(compression, Compression::B44 | Compression::DWAA(_));
        assert!(errors.fold(0.0, f32::max) <= if lossy { 0.5 } else { 0.0 }, "{compression}");
    }
}

#[test]
fn what_this_project_writes_as_openexr_is_read_to_the_last_bit() {
    let path = tempfile::tempdir().unwrap().keep().join("a.exr");
    sample().write_exr(&path).unwrap();
    assert_eq!(Image::read(&path).unwrap(), sample());
    fs::remove_dir_all(path.parent().unwrap()).unwrap();
}

#[test]
fn the_exposure_of_a_radiance_header_is_taken_back() {
    let text = "#?RGBE\nEXPOSURE=4\nCOLORCORR=1 2 1\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n";
    let bytes = [text.as_bytes(), &[128, 128, 128, 129]].concat();
    assert_eq!(read(&bytes).unwrap().get(0, 0), Rgb([0.25, 0.125, 0.25]));
}

#[test]
fn run_lengths_beyond_any_row_are_refused() {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 9\n\x80\x80\x80\x80".to_vec();
    bytes.extend([1, 1, 1, 0].repeat(7));
    bytes.extend([1, 1, 1, 255].repeat(3));
    assert!(matches!(read(&bytes), Err(ImageReadProblem::Damaged { .. })));
}

#[test]
fn sizes_are_refused_from_the_header_before_any_pixel_is_asked_for() {
    for size in ["-Y 4097 +X 8192", "-Y 1 +X 8193", "-Y 0 +X 2", "-Y 4294967295 +X 4294967295"] {
        let bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
        let problem = read(&bytes).unwrap_err();
        use ImageReadProblem::{Damaged, Size, Unsupported};
        assert!(matches!(problem, Size { .. } | Damaged { .. } | Unsupported { .. }), "{problem}");
    }
    // The data window of the file, its largest column made 2^20.
    let mut bytes = exr(&sample(), Compression::Uncompressed);
    let window = bytes.windows(10).position(|name| name == b"dataWindow").unwrap();
    bytes[window + 29..window + 33].copy_from_slice(&(1_i32 << 20).to_le_bytes());
    let problem = read(&bytes).unwrap_err();
    assert!(matches!(problem, ImageReadProblem::Size { .. }), "{problem}");
}

#[test]
fn kinds_of_radiance_pictures_that_are_not_read_are_not_called_damaged() {
    for header in ["FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n", "FORMAT=32-bit_rle_rgbe\n\n+Y 1 +X 2\n"] {
        let problem = read(format!("#?RADIANCE\n{header}\x40\x40\x40\x40").as_bytes()).unwrap_err();
        assert!(matches!(problem, ImageReadProblem::Unsupported { .. }), "{problem}");
    }
}

#[test]
fn layers_and_channels_other_than_rgb_are_named() {
    let grey = read(&layers(&[("a", &["Y"])])).unwrap_err().to_string();
    assert!(grey.contains("found 1 layer with Y"), "{grey}");
    let two = read(&layers(&[("a", &["R", "G", "B"]), ("b", &["R", "G", "B"])])).unwrap_err().to_string();
    assert!(two.contains("found 2 layers with B, G, R"), "{two}");
    assert!(read(&layers(&[("a", &["R", "G", "B", "Z"])])).is_ok());
}

#[test]
fn hundreds_of_channels_are_refused_before_memory_is_taken_for_them() {
    let names: Vec<String> = (0..100).map(|channel| format!("x{channel}")).collect();
    let names: Vec<&str> = ["R", "G", "B"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let many = read(&layers(&[("a", &names)])).unwrap_err().to_string();
    assert!(many.contains("... (103 channels)"), "{many}");
}

#[test]
fn errors_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    let said = || Image::read(&path).unwrap_err().to_string();
    assert!(said().contains("a.hdr: "));
    fs::write(&path, b"hello").unwrap();
    assert!(said().contains("a.hdr: expected a Radiance (.hdr) or OpenEXR (.exr) picture"), "{}", said());
    fs::File::create(&path).unwrap().set_len(MAX_FILE + 1).unwrap();
    assert!(said().contains("found 671088641: scale the picture down"), "{}", said());
    assert!(Image::read(folder.path()).is_err());
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let whole = [hdr(&sample()), exr(&sample(), Compression::ZIP16), exr(&sample(), Compression::Uncompressed)];
    for bytes in whole {
        for end in 0..bytes.len() {
            assert!(read(&bytes[..end]).is_err(), "{end} of {} bytes", bytes.len());
        }
    }
}

#[test]
fn a_header_that_claims_more_than_the_file_can_hold_is_refused_before_memory_is_asked_for() {
    let claim = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4096 +X 8192\n\x01\x01\x01\x80";
    let error = read(claim).unwrap_err();
    assert!(matches!(error, ImageReadProblem::Claim { width: 8192, height: 4096, .. }), "{error}");
    // What compresses best is still read: black, in halves.
    let black = Image::black(2048, 1024);
    for compression in [Compression::ZIP16, Compression::PIZ, Compression::RLE] {
        assert_eq!(read(&exr(&black, compression)).unwrap(), black, "{compression:?}");
    }
    assert_eq!(read(&hdr(&black)).unwrap(), black);
}

#[test]
fn tiles_that_reach_far_beyond_the_picture_are_refused() {
    let tiled = |side: usize| {
        let encoding = Encoding { blocks: Blocks::Tiles(Vec2(side, side)), ..Encoding::FAST_LOSSLESS };
        let channels = SpecificChannels::rgb(|_: Vec2<usize>| (0.5_f32, 0.25_f32, 0.125_f32));
        let layer = Layer::new((16, 8), LayerAttributes::default(), encoding, channels);
        let mut bytes = Cursor::new(Vec::new());
        ExrImage::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    assert_eq!(read(&tiled(64)).unwrap().get(15, 7), Rgb([0.5, 0.25, 0.125]));
    let mut bytes = tiled(64);
    let place = bytes.windows(9).position(|window| window == b"tiledesc\0").unwrap() + 13;
    bytes[place..place + 4].copy_from_slice(&1_900_544_u32.to_le_bytes());
    let error = read(&bytes).unwrap_err().to_string();
    assert!(error.contains("tiles of 1900544 × 64 pixels in a picture of 16 × 8"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2048))]

    #[test]
    fn no_bytes_make_the_reader_panic(
        compression in 0..COMPRESSIONS.len() + 1,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        end in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let mut bytes = COMPRESSIONS.get(compression).map_or_else(|| hdr(&sample()), |&how| exr(&sample(), how));
        for (place, value) in changes {
            let place = place.index(bytes.len());
            bytes[place] = value;
        }
        bytes.truncate(end.map_or(bytes.len(), |end| end.index(bytes.len())));
        if let Ok(image) = read(&bytes) {
            prop_assert!(image.width() <= MAX_WIDTH && image.height() <= MAX_HEIGHT);
        }
    }
}
