//! Threads that do one kind of work beside the user interface.
//!
//! The viewer decides what is worth doing; a thread only takes the next job.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::{fmt, io};

/// What happens to waiting jobs and to the one at work when the pool is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::viewer) enum AtEnd {
    /// Every job is done first: files are to be whole.
    Complete,
    /// Waiting jobs are dropped and the one at work is left alone: it may take long, and nobody needs it.
    Detach,
}

/// Threads that share a queue of jobs.
pub(in crate::viewer) struct WorkerPool<J> {
    queue: Arc<Queue<J>>,
    threads: Vec<JoinHandle<()>>,
    at_end: AtEnd,
}

struct Queue<J> {
    state: Mutex<QueueState<J>>,
    changed: Condvar,
}

struct QueueState<J> {
    jobs: VecDeque<J>,
    ended: bool,
}

impl<J> fmt::Debug for WorkerPool<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WorkerPool")
            .field("threads", &self.threads)
            .finish_non_exhaustive()
    }
}

impl<J: Send + 'static> WorkerPool<J> {
    /// Starts `count` threads called `name`, each of which calls `work` with every job it takes. `work` must not
    /// panic; use [`guarded`].
    ///
    /// # Errors
    /// When the system gives no thread.
    pub(in crate::viewer) fn start(
        name: &str,
        count: usize,
        at_end: AtEnd,
        work: impl Fn(J) + Clone + Send + 'static,
    ) -> io::Result<Self> {
        let queue = Arc::new(Queue {
            state: Mutex::new(QueueState {
                jobs: VecDeque::new(),
                ended: false,
            }),
            changed: Condvar::new(),
        });
        let mut workers = Self {
            queue,
            threads: Vec::new(),
            at_end,
        };
        for _ in 0..count {
            let (queue, work) = (Arc::clone(&workers.queue), work.clone());
            let serve = move || {
                while let Some(job) = queue.take() {
                    work(job);
                }
            };
            workers.threads.push(Builder::new().name(name.to_owned()).spawn(serve)?);
        }
        Ok(workers)
    }

    /// Adds a job behind those that wait.
    pub(in crate::viewer) fn push(&self, job: J) {
        self.queue.lock().jobs.push_back(job);
        self.queue.changed.notify_one();
    }

    /// Takes back the jobs that wait.
    pub(in crate::viewer) fn take_back(&self) -> VecDeque<J> {
        std::mem::take(&mut self.queue.lock().jobs)
    }

    /// Adds a job in place of those that wait, which it returns.
    pub(in crate::viewer) fn replace(&self, job: J) -> VecDeque<J> {
        let dropped = std::mem::replace(&mut self.queue.lock().jobs, VecDeque::from([job]));
        self.queue.changed.notify_one();
        dropped
    }
}

impl<J> Drop for WorkerPool<J> {
    fn drop(&mut self) {
        {
            let mut state = self.queue.lock();
            state.ended = true;
            if self.at_end != AtEnd::Complete {
                state.jobs.clear();
            }
        }
        self.queue.changed.notify_all();
        if self.at_end != AtEnd::Detach {
            for thread in self.threads.drain(..) {
                // A panic was reported by its thread already.
                let _ = thread.join();
            }
        }
    }
}

impl<J> Queue<J> {
    /// The queue is whole even if a thread panicked while it held the lock.
    fn lock(&self) -> MutexGuard<'_, QueueState<J>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next job; `None` once there will be none.
    fn take(&self) -> Option<J> {
        let mut state = self.lock();
        loop {
            if let Some(job) = state.jobs.pop_front() {
                return Some(job);
            }
            if state.ended {
                return None;
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Runs `work`; a panic inside, which is a defect of the program, becomes `None` instead of the end of a thread that
/// others wait for.
pub(in crate::viewer) fn guarded<R>(work: impl FnOnce() -> R) -> Option<R> {
    catch_unwind(AssertUnwindSafe(work)).ok()
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn crew_completes_what_waits() {
        let count = Arc::new(AtomicUsize::new(0));
        let seen = Arc::clone(&count);
        let work = move |n: usize| {
            seen.fetch_add(n, Ordering::SeqCst);
        };
        let workers = WorkerPool::start("test", 2, AtEnd::Complete, work).expect("threads");
        (1..=100).for_each(|n| workers.push(n));
        drop(workers);
        assert_eq!(count.load(Ordering::SeqCst), 5050, "all jobs were done before the end");
    }

    #[test]
    fn detached_crew_is_not_waited_for() {
        let (begun, begins) = std::sync::mpsc::channel();
        let (end, ended) = std::sync::mpsc::channel::<()>();
        let ended = Arc::new(Mutex::new(ended));
        let work = move |(): ()| {
            begun.send(()).expect("somebody listens");
            // Until the sender is gone.
            let _ = ended.lock().expect("no panic").recv();
        };
        let workers = WorkerPool::start("test", 1, AtEnd::Detach, work).expect("a thread");
        workers.push(());
        begins.recv().expect("a job at work");
        drop(workers);
        end.send(()).expect("it is still at work");
    }

    #[test]
    fn guarded_keeps_the_thread() {
        assert_eq!(guarded(|| 7), Some(7), "no panic");
    }
}
