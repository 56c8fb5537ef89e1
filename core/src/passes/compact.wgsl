// Step-II-b and Step-III-b: the dense list is there, the dispatch that works through it is not yet.

struct Dispatch {
    x: u32,
    y: u32,
    z: u32,
}

var<storage, read> list: List;
var<storage, read_write> dispatch: Dispatch;

@compute @workgroup_size(1)
fn main() {
    let groups = (list.count + TRACE_GROUP - 1u) / TRACE_GROUP;
    let rows = (groups + TRACE_ROW - 1u) / TRACE_ROW;
    dispatch = Dispatch(min(groups, TRACE_ROW), rows, 1u);
}
