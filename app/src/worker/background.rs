//! Threads that give way to the window: on few cores it must not wait for the work beside it.

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

/// Of 0 to 99; 40 is a niceness of 3: the window goes first, and pictures still come.
const PRIORITY: u8 = 40;

/// A thread for long work.
pub(super) fn spawn(work: impl FnOnce() + Send + 'static) {
    std::thread::spawn(move || {
        give_way();
        work();
    });
}

/// Lets threads that share parallel work give way, too; call it before there is any. A pool that is there already stays
/// as it is: that of a command with a number of threads.
pub fn prepare() {
    // Nothing is lost where there is a pool already.
    let _ = rayon::ThreadPoolBuilder::new().start_handler(|_| give_way()).build_global();
}

/// Where the system does not let a thread choose, it stays as it was.
fn give_way() {
    if let Ok(priority) = ThreadPriorityValue::try_from(PRIORITY) {
        let _ = set_current_thread_priority(ThreadPriority::Crossplatform(priority));
    }
}
