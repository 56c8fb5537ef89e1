//! The accumulator: sends views to the workers and sums their finished planes.

use std::sync::{
    Arc,
    atomic::Ordering,
    mpsc::{Receiver, Sender, channel, sync_channel},
};

use super::{Delivery, Order, SampleCounts, SampleImage, Tally, View, Worker};

/// Collects finished planes from the workers, each once. Blocks only in [`Accumulator::finish`].
pub struct Accumulator {
    order: Arc<Order>,
    cores: Vec<Core>,
    /// The sum of collected planes that the renderer has not taken yet.
    fresh: Option<SampleImage>,
    merged: u64,
    tally: Arc<Tally>,
}

/// The owner's end of the channel to a worker thread.
struct Core {
    /// Sends views to trace; `None` once the worker has been told to end.
    orders: Option<Sender<Arc<Order>>>,
    deliveries: Receiver<Delivery>,
    /// Number of the current view's samples collected from this worker.
    samples: u32,
}

impl Accumulator {
    /// Creates an accumulator for a view and a worker for each CPU thread.
    #[must_use]
    pub fn new(view: &View, cores: usize) -> (Self, Vec<Worker>) {
        let tally = Arc::new(Tally::default());
        let order = Order::new(view, &tally);
        let pairs = (0..cores).map(|_| {
            let (orders, ordered) = channel();
            // One plane is in the channel while the worker traces the next.
            let (deliver, deliveries) = sync_channel(1);
            let core = Core { orders: Some(orders), deliveries, samples: 0 };
            (core, Worker::new(ordered, deliver, order.clone()))
        });
        let (cores, workers) = pairs.unzip();
        (Self { order, cores, fresh: None, merged: 0, tally }, workers)
    }

    /// Changes the view. Samples of another view, finished or not, are discarded.
    pub fn show(&mut self, view: &View) {
        if self.order.view == *view {
            return;
        }
        self.order = Order::new(view, &self.tally);
        if let Some(image) = self.fresh.take() {
            self.merged -= u64::from(image.samples);
            self.tally.give_up(image.samples);
        }
        for core in &mut self.cores {
            core.samples = 0;
            if let Some(orders) = &core.orders {
                // Sending fails only if the worker has ended.
                let _ = orders.send(self.order.clone());
            }
        }
    }

    /// Collects finished planes from all workers without waiting.
    pub fn collect(&mut self) {
        for index in 0..self.cores.len() {
            while let Ok(delivery) = self.cores[index].deliveries.try_recv() {
                self.receive(index, delivery);
            }
        }
    }

    /// Takes the sum of the planes collected since the last call; `None` if there are none.
    pub fn take(&mut self) -> Option<SampleImage> {
        self.fresh.take()
    }

    /// Ends the work. Workers still deliver finished planes and discard unfinished ones.
    pub fn close(&mut self) {
        self.cores.iter_mut().for_each(|core| core.orders = None);
    }

    /// [Closes](Accumulator::close) and collects the last planes: waits until each worker has finished its row or
    /// ended. For workers on threads of their own; a caller that steps workers itself closes, steps and collects.
    pub fn finish(&mut self) {
        self.close();
        for index in 0..self.cores.len() {
            while let Ok(delivery) = self.cores[index].deliveries.recv() {
                self.receive(index, delivery);
            }
        }
    }

    /// Number of the current view's samples collected from each worker.
    #[must_use]
    pub fn samples(&self) -> Vec<u32> {
        self.cores.iter().map(|core| core.samples).collect()
    }

    /// Number of samples begun, merged and given up so far.
    #[must_use]
    pub fn sample_counts(&self) -> SampleCounts {
        SampleCounts {
            begun: self.tally.begun.load(Ordering::Relaxed),
            merged: self.merged,
            given_up: self.tally.given_up.load(Ordering::Relaxed),
        }
    }

    fn receive(&mut self, index: usize, Delivery { order, image }: Delivery) {
        if !Arc::ptr_eq(&order, &self.order) {
            self.tally.give_up(image.samples);
            return;
        }
        self.cores[index].samples += image.samples;
        self.merged += u64::from(image.samples);
        match &mut self.fresh {
            Some(fresh) => fresh.add(&image),
            None => self.fresh = Some(image),
        }
    }
}
