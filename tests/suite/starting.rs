//! The smallest whole: an empty program starts.

use rasterscope::raster::SampleRate;

#[test]
fn sample_rate_squares_only() {
    assert_eq!(SampleRate::new(16).unwrap().side(), 4, "16 is 4 x 4");
    assert!(SampleRate::new(5).is_none(), "5 is no square");
}
