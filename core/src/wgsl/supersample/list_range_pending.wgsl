// Range of the list that is dispatched: refined pixels whose next samples are not traced yet.

const LIST_SAMPLES: u32 = 4u;

fn list_begin(done: u32) -> u32 {
    return done;
}

fn list_end(count: u32, begin: u32) -> u32 {
    return count;
}
