// Appends pixels to the list of samples to trace.

struct ListOut {
    count: atomic<u32>,
    begin: u32,
    end: u32,
    padding: u32,
    pixels: array<u32>,
}

var<storage, read_write> list: ListOut;

// Lists the pixel for tracing. Deviation: packs the list with an atomic counter instead of parallel scans, which
// leaves only the indirect dispatch to Step-II-b.
fn list_append(pixel: vec2u) {
    let place = atomicAdd(&list.count, 1u);
    list.pixels[place] = list_entry(pixel);
}
