//! Scrubbing asks the system for no memory: from the slider's value to the bytes on the display.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use dhat::{Alloc, HeapStats, Profiler};
use nbrdf::catalog::{Catalog, Reference};
use nbrdf::gui::session::Methods;
use nbrdf::gui::{Session, Workbench};
use nbrdf::worker::{Answer, Card, Lighting, Request, Scenery, Stock, Timing, Walk, Worker};
use nbrdf_core::Weights;
use nbrdf_core::library::builtin;
use nbrdf_core::render::{Scrub, Sphere};

#[global_allocator]
static ALLOCATOR: Alloc = Alloc;

/// The whole process is counted: one test at a time.
static COUNTING: Mutex<()> = Mutex::new(());

#[test]
fn a_frame_of_scrubbing_allocates_nothing() {
    let _alone = COUNTING.lock().unwrap_or_else(PoisonError::into_inner);
    let _profiler = Profiler::builder().testing().build();
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let ends = ["gold-paint", "blue-acrylic"].map(|name| builtin::shared().get(name).unwrap().material());
    let sphere = Arc::new(Sphere::new(96, Sphere::studio().light()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let methods = ["latent", "latent_even", "latent_geodesic", "latent_refined", "raw_weights", "aligned_weights"];
    for method in methods.into_iter().chain(["shared_start"]) {
        let path = Arc::from(catalog.interpolation(method).unwrap().between(&ends).unwrap());
        let mut scrub = Scrub::new(Arc::clone(&sphere), path, &Weights::two(0.0)).unwrap();
        let before = scrub.display_bytes().to_vec();
        assert!(HeapStats::get().total_blocks > 0, "allocations are counted");
        let mut frames = |count: usize| {
            for frame in 0..count {
                // Half the way beyond each end, too.
                scrub.show(&Weights::two(2.0 * frame as f32 / count as f32 - 0.5), 1.0).unwrap();
            }
        };
        // The first frames warm up what each thread keeps.
        let mut round = || {
            let start = HeapStats::get().total_blocks;
            frames(100);
            HeapStats::get().total_blocks - start
        };
        let counted = pool.install(|| {
            round();
            // The harness tells of tests that take long, from a thread of its own: that may fall into one of them.
            [round(), round(), round()]
        });
        assert!(counted.contains(&0), "{method}: {counted:?} allocations in 100 frames");
        assert_ne!(scrub.display_bytes(), before, "{method}: the picture has moved");
    }
}

/// Four spheres of 256² and their figures, through the threads of the app: a picture alone would be 256 KiB.
#[test]
fn the_apps_threads_allocate_no_picture_per_frame() {
    const FRAMES: usize = 50;
    let _alone = COUNTING.lock().unwrap_or_else(PoisonError::into_inner);
    let _profiler = Profiler::builder().testing().build();
    let mut stock = Stock::built_in();
    stock.materials.retain(|material| ["gold-paint", "blue-acrylic"].contains(&material.name.as_str()));
    let mut worker = Worker::start(stock, || ());
    let plates = worker.plates();
    let mut request = Request {
        explored: None,
        ends: Arc::new(["gold-paint".to_owned(), "blue-acrylic".to_owned()]),
        weights: Weights::two(0.0),
        timing: Timing::Straight,
        walk: Walk::default(),
        methods: vec!["latent", "raw_weights"],
        scenery: Scenery::of(Lighting::Point(nbrdf_core::Vec3::new(0.0, 0.6, 0.8))),
        exposure: 0.5,
        tone: nbrdf_core::image::Tone::Clip,
        size: 256,
        strip: 0,
        closeup: None,
    };
    let mut frames = |count: usize| {
        let (mut pictures, mut figures) = (0, 0);
        for frame in 0..count {
            request.weights = Weights::two((frame as f32 + 0.5) / count as f32);
            let number = worker.show(request.clone());
            let mut is_done = false;
            while !is_done {
                std::thread::sleep(Duration::from_micros(200));
                for answer in worker.answers() {
                    match answer {
                        Answer::Done(done) => is_done = done == number,
                        Answer::Picture(card, picture) => {
                            pictures += usize::from(matches!(card, Card::Method(_)));
                            plates.give_back(picture.rgba);
                        }
                        Answer::Thumbnail(_, picture) => plates.give_back(picture.rgba),
                        Answer::Figures(..) => figures += 1,
                        Answer::Failed(_, why) | Answer::Notice(why) => panic!("{why}"),
                        _ => {}
                    }
                }
            }
        }
        (pictures, figures)
    };
    frames(20);
    let mut round = || {
        let start = HeapStats::get().total_bytes;
        let (pictures, figures) = frames(FRAMES);
        assert!(pictures >= 2 * FRAMES && figures >= 4 * FRAMES, "{pictures} pictures, {figures} figures");
        (HeapStats::get().total_bytes - start) / FRAMES as u64
    };
    // On a busy machine what threads make once (thumbnails, workspaces) may fall into the first rounds.
    let per_frame = [(); 3].map(|()| round());
    assert!(per_frame.into_iter().any(|bytes| bytes < 16 * 1024), "{per_frame:?} bytes per frame");
}

/// What a window keeps must not grow: textures, answers, undo, whatever is remembered from frame to frame.
#[test]
fn ten_thousand_frames_of_scrubbing_keep_no_more_memory() {
    const WARM_UP: usize = 1_000;
    const FRAMES: usize = 10_000;
    let _alone = COUNTING.lock().unwrap_or_else(PoisonError::into_inner);
    let _profiler = Profiler::builder().testing().build();
    let mut stock = Stock::built_in();
    stock.materials.retain(|material| ["gold-paint", "blue-acrylic"].contains(&material.name.as_str()));
    let mut session = Session { methods: Methods(vec!["latent"]), strips: false, ..Session::default() };
    session.look.scenery.lighting = Lighting::Point(nbrdf_core::Vec3::new(0.0, 0.6, 0.8));
    let workbench = Workbench::new(stock, session);
    let show = |ui: &mut egui::Ui, workbench: &mut Workbench| workbench.ui(ui);
    let mut harness = egui_kittest::Harness::builder().with_size([700.0, 500.0]).build_ui_state(show, workbench);
    let mut scrub = |frames: usize| {
        for frame in 0..frames {
            harness.state_mut().session.blend.t = (frame % 100) as f32 / 100.0;
            harness.step();
        }
        // What is still on its way would count.
        while !harness.state().is_settled() {
            std::thread::sleep(Duration::from_millis(1));
            harness.step();
        }
        HeapStats::get().curr_bytes
    };
    let before = scrub(WARM_UP);
    let after = scrub(FRAMES);
    let grown = after.saturating_sub(before);
    assert!(grown < 256 << 10, "{grown} bytes more after {FRAMES} frames than after {WARM_UP}: {before}, then {after}");
}
