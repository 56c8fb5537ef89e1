//! Counts of kernels whose demands are known.

use super::*;
use crate::device::shader::{Source, link};

fn counted(body: &str, function: Option<&str>, apart: &[&str]) -> Option<ByLoops> {
    let text = "var<storage, read> nodes: array<vec4u>;\nvar<storage, read_write> attributes: array<u32>;\n\
                var<uniform> frame: vec4f;\nconst ON: bool = true;\n"
        .to_owned()
        + body;
    count(&link(&[Source { file: "a.wgsl", text: text.into() }]).expect("links"), function, apart)
}

fn demand(operations: f64, scene_bytes: f64, frame_bytes: f64) -> Demand {
    Demand { operations, scene_bytes, frame_bytes }
}

#[test]
fn arithmetic_counts_by_components_and_bytes_by_buffer() {
    let body = "@compute @workgroup_size(1) fn main() {
        let n = vec4f(nodes[7]);                   // 16 bytes, 4 conversions
        let d = dot(n, frame);                     // 7
        let q = n.xyz / d;                         // 12
        attributes[3] = attributes[2] + u32(q.x);  // 1 sum, 1 conversion, 8 bytes
    }";
    let [once, ..] = counted(body, None, &[]).expect("an entry point");
    assert_eq!(once, demand(4.0 + 7.0 + 12.0 + 2.0, 16.0, 8.0));
}

#[test]
fn loops_are_told_apart_and_functions_left_out() {
    let body = "fn inner(x: u32) -> u32 { return x * x; }
        fn rare(x: u32) -> u32 { return x / x; }
        fn outer(n: u32) -> u32 {
            var x = n + 1u;
            loop {
                x = inner(x) - 1u;
                loop { x = x ^ 5u; x = inner(x); if x > 9u { break; } }
                x += rare(x);
                if x > 99u { break; }
            }
            return x;
        }
        @compute @workgroup_size(1) fn main() { attributes[0] = outer(attributes[1]); }";
    let operations = |by: ByLoops| by.map(|demand| demand.operations);
    let rare = counted(body, Some("outer"), &["rare"]).map(operations);
    assert_eq!(rare, Some([1.0, 2.0 + 1.0 + 1.0, 1.0 + 1.0 + 1.0]));
    let all = counted(body, Some("outer"), &[]).map(operations);
    assert_eq!(all, Some([1.0, 4.0 + SPECIAL, 3.0]));
    assert_eq!(counted(body, Some("missing"), &[]), None);
    let main = counted(body, None, &["outer"]).expect("an entry point");
    assert_eq!(main, [demand(0.0, 0.0, 8.0), Demand::default(), Demand::default()]);
}

#[test]
fn the_longer_branch_counts_unless_the_condition_is_known() {
    let body = |condition: &str| {
        format!(
            "fn f(x: f32) -> f32 {{ if {condition} {{ return x * x; }} return x + x + x; }}
             @compute @workgroup_size(1) fn main() {{ attributes[0] = u32(f(frame.x)); }}"
        )
    };
    let of = |condition: &str| counted(&body(condition), Some("f"), &[]).map(|by| by[0].operations);
    assert_eq!(of("ON"), Some(1.0), "what comes after the return is never reached");
    assert_eq!(of("!ON"), Some(2.0));
    assert_eq!(of("x > 1.0"), Some(1.0 + 1.0 + 2.0), "the comparison, and what each side does");
}
