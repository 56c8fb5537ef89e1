//! The owner's side: orders out, planes in.

use std::sync::{
    Arc,
    atomic::Ordering,
    mpsc::{Receiver, Sender, channel, sync_channel},
};

use super::{Delivery, Order, SampleCounts, SampleImage, Tally, View, Worker};

/// Takes what cores finish, each plane once, and never waits for them until the work ends.
pub struct Accumulator {
    order: Arc<Order>,
    cores: Vec<Core>,
    /// Merged, and not yet with the renderer.
    fresh: Option<SampleImage>,
    merged: u64,
    tally: Arc<Tally>,
}

/// The owner's end of the channel to a worker thread.
struct Core {
    /// Sends views to trace; `None` once the worker is told to end.
    orders: Option<Sender<Arc<Order>>>,
    deliveries: Receiver<Delivery>,
    /// Number of samples of the present view that were merged into the frame.
    samples: u32,
}

impl Accumulator {
    /// Work on a view for so many cores, and the side of each.
    #[must_use]
    pub fn new(view: &View, cores: usize) -> (Self, Vec<Worker>) {
        let tally = Arc::new(Tally::default());
        let order = Order::new(view, &tally);
        let pairs = (0..cores).map(|_| {
            let (orders, ordered) = channel();
            // One plane is on its way while the next is being traced.
            let (deliver, deliveries) = sync_channel(1);
            let core = Core { orders: Some(orders), deliveries, samples: 0 };
            (core, Worker::new(ordered, deliver, order.clone()))
        });
        let (cores, workers) = pairs.unzip();
        (Self { order, cores, fresh: None, merged: 0, tally }, workers)
    }

    /// Planes are of this view from now on. What there is of another one is given up.
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
                // A worker that is gone needs none.
                let _ = orders.send(self.order.clone());
            }
        }
    }

    /// Merges what cores have handed over; waits for nothing.
    pub fn collect(&mut self) {
        for index in 0..self.cores.len() {
            while let Ok(delivery) = self.cores[index].deliveries.try_recv() {
                self.receive(index, delivery);
            }
        }
    }

    /// What has been merged since this was last asked for.
    pub fn take(&mut self) -> Option<SampleImage> {
        self.fresh.take()
    }

    /// Wants no more. Cores hand over what they have finished, and give up what they have begun.
    pub fn close(&mut self) {
        self.cores.iter_mut().for_each(|core| core.orders = None);
    }

    /// [Closes](Accumulator::close), and merges the last of every core: waits until each has come to the end of its row, or is gone.
    /// For workers on threads of their own; who steps them by itself closes, steps and collects.
    pub fn finish(&mut self) {
        self.close();
        for index in 0..self.cores.len() {
            while let Ok(delivery) = self.cores[index].deliveries.recv() {
                self.receive(index, delivery);
            }
        }
    }

    /// How many samples of the present view each core has brought.
    #[must_use]
    pub fn samples(&self) -> Vec<u32> {
        self.cores.iter().map(|core| core.samples).collect()
    }

    /// How many samples were begun, finished and dropped so far.
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
