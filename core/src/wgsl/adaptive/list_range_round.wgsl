// Range of the list that is dispatched: entries not yet processed, at most as many as a round may trace.

const LIST_SAMPLES: u32 = 1u;

fn list_begin(done: u32) -> u32 {
    return done;
}

fn list_end(count: u32, begin: u32) -> u32 {
    return begin + min(count - begin, ROUND_SAMPLES);
}
