// Appending to the list of samples to be traced.

struct ListOut {
    count: atomic<u32>,
    begin: u32,
    end: u32,
    padding: u32,
    pixels: array<u32>,
}

var<storage, read_write> list: ListOut;

// Lists the pixel for tracing. Deviation: packing by an atomic counter, which keeps the order within a row of
// threads, instead of by parallel scans; Step-II-b is left with the dispatch.
fn list_append(pixel: vec2u) {
    let place = atomicAdd(&list.count, 1u);
    list.pixels[place] = list_entry(pixel);
}
