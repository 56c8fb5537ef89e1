// Step-II-b and Step-III-b (Kim 2016, Table 2): the list is already dense; writes the arguments of the indirect
// dispatches over a range of it, which one of the files `list_range_*.wgsl` selects.

struct Dispatch {
    x: u32,
    y: u32,
    z: u32,
}

var<storage, read_write> list: List;
// One entry for each chunk of the longest possible list.
var<storage, read_write> dispatch: array<Dispatch>;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) local: u32) {
    let begin = list_begin(list.end);
    let count = list_end(list.count, begin) - begin;
    let all = LIST_SAMPLES * count;
    workgroupBarrier();
    for (var chunk = local; chunk < arrayLength(&dispatch); chunk += 64u) {
        let first = min(chunk * CHUNK_SAMPLES, all);
        let samples = min(all - first, CHUNK_SAMPLES);
        dispatch[chunk] = Dispatch((samples + TRACE_GROUP - 1u) / TRACE_GROUP, 1u, 1u);
    }
    if local == 0u {
        list.begin = begin;
        list.end = begin + count;
    }
}
