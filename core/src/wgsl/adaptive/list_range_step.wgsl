// Range of the list that is dispatched: entries that the previous step has appended.

const LIST_SAMPLES: u32 = 1u;

fn list_begin(done: u32) -> u32 {
    return done;
}

fn list_end(count: u32, begin: u32) -> u32 {
    return count;
}
