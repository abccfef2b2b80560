//! Parts of a picture: the bytes of the whole, in any order, until cancelled.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rasterscope::raster::{Framebuffer, Region};
use rasterscope::render::{CancelToken, Subject, draw_regions, refine};

use crate::support::scenes::{Fills, at_rate, drawn, one_to_one, random};

const SIZE: [u32; 2] = [150, 130];

#[test]
fn regions_hold_the_bytes_of_the_whole_frame() {
    arbtest::arbtest(|u| {
        let (scene, settings) = (random(u, 80, Fills::Everything)?, at_rate(*u.choose(&[1, 4, 16, 64])?));
        let view = one_to_one(SIZE);
        let whole = drawn(&scene, &view, &settings, SIZE);
        let mut regions = Vec::new();
        for _ in 0..u.int_in_range(0..=4)? {
            regions.push(Region {
                x: u.int_in_range(0..=160)?,
                y: u.int_in_range(0..=140)?,
                width: u.int_in_range(0..=100)?,
                height: u.int_in_range(0..=100)?,
            });
        }
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
        let paper = 0x1234_5678;
        frame.pixels_mut().fill(paper);
        draw_regions(&subject, &mut frame, &regions, &CancelToken::default()).expect("not cancelled");
        for (i, (now, then)) in (0..).zip(frame.pixels().iter().zip(whole.pixels())) {
            let [x, y] = [i % SIZE[0], i / SIZE[0]];
            let inside =
                |region: &Region| (region.x..region.right()).contains(&x) && (region.y..region.bottom()).contains(&y);
            let expected = if regions.iter().any(inside) { *then } else { paper };
            assert_eq!(*now, expected, "pixel {x}, {y} with {regions:?}, {settings:?}");
        }
        Ok(())
    })
    .budget_ms(1500);
}

#[test]
fn refining_comes_nearest_first_and_ends_in_the_same_bytes() {
    arbtest::arbtest(|u| {
        let (scene, settings) = (random(u, 80, Fills::Everything)?, at_rate(*u.choose(&[1, 16])?));
        let view = one_to_one(SIZE);
        let from = [u.int_in_range(0..=200)?, u.int_in_range(0..=200)?];
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
        let arrived = Mutex::new((Vec::new(), &mut frame));
        let publish = |tile: Region, pixels: &[u32]| {
            let mut arrived = arrived.lock().unwrap();
            arrived.0.push(tile);
            arrived.1.copy_from(tile, pixels, tile);
        };
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        let stats = one.install(|| refine(&subject, SIZE, from, &CancelToken::default(), publish));
        assert!(stats.is_some(), "not cancelled");
        let tiles = arrived.into_inner().unwrap().0;
        let area: u32 = tiles.iter().map(|tile| tile.width * tile.height).sum();
        assert_eq!(area, SIZE[0] * SIZE[1], "each pixel comes once");
        let distance = |tile: &Region| {
            let along =
                |start: u32, length: u32, at: u32| f64::from(start) + f64::from(length) / 2.0 - f64::from(at) - 0.5;
            along(tile.x, tile.width, from[0]).hypot(along(tile.y, tile.height, from[1]))
        };
        assert!(
            tiles.is_sorted_by(|a, b| distance(a) <= distance(b) + 1e-9),
            "from {from:?} outwards: {tiles:?}"
        );
        assert!(frame == drawn(&scene, &view, &settings, SIZE), "the whole picture");
        Ok(())
    })
    .budget_ms(1500);
}

#[test]
fn refining_stops_when_cancelled() {
    let mut u = arbtest::arbitrary::Unstructured::new(&[7; 4000]);
    let (scene, settings) = (random(&mut u, 80, Fills::Everything).expect("a scene"), at_rate(16));
    let view = one_to_one(SIZE);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    let (cancel, count) = (CancelToken::default(), AtomicUsize::new(0));
    let stats = refine(&subject, SIZE, [0, 0], &cancel, |_, _| {
        if count.fetch_add(1, Ordering::SeqCst) == 2 {
            cancel.cancel();
        }
    });
    let painted = count.load(Ordering::SeqCst);
    let threads = rayon::current_num_threads();
    assert!(stats.is_none(), "unfinished");
    assert!(
        (3..=3 + threads).contains(&painted),
        "{painted} tiles on {threads} threads"
    );
    let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
    assert!(
        draw_regions(&subject, &mut frame, &[Region::of_size(SIZE)], &cancel).is_none(),
        "nor this"
    );
}
