//! Modes TRIANGLES and INDICES: indices as differences, those of triangles also by edges and vertices that were
//! used before.

use super::{Decoded, Reader, truncated, unzigzag, version};

/// The last 16 values, by how many others came after.
struct Recent<T> {
    values: [T; 16],
    next: usize,
}

impl<T: Copy> Recent<T> {
    fn new(empty: T) -> Self {
        Self { values: [empty; 16], next: 0 }
    }

    fn push(&mut self, value: T) {
        self.values[self.next] = value;
        self.next = (self.next + 1) % 16;
    }

    fn get(&self, age: usize) -> T {
        self.values[(self.next + 32 - 1 - age) % 16]
    }
}

/// What the codes of triangles refer to.
struct Triangles<'b> {
    reader: Reader<'b>,
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
    /// The lowest index that did not occur yet.
    next: u32,
    /// The last index that was stored as a difference.
    last: u32,
}

impl Triangles<'_> {
    fn new_index(&mut self) -> u32 {
        self.next = self.next.wrapping_add(1);
        self.next.wrapping_sub(1)
    }

    fn stored(&mut self) -> Decoded<u32> {
        self.last = self.reader.difference(self.last)?;
        Ok(self.last)
    }

    /// A triangle on a recent edge; `limit` is the first code of its third vertex that is no recent vertex.
    fn on_edge(&mut self, edge: usize, third: u8, limit: u8) -> Decoded<[u32; 3]> {
        let [a, b] = self.edges.get(edge);
        let c = match third {
            0 => self.new_index(),
            third if third < limit => self.vertices.get(usize::from(third)),
            15 => self.stored()?,
            // 13 and 14 stand for -1 and 1.
            third => {
                self.last = self.last.wrapping_add(u32::from(third) * 2).wrapping_sub(27);
                self.last
            }
        };
        if third == 0 || third >= limit {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok([a, b, c])
    }

    /// A triangle of three vertices by their codes: 0 a new one, 15 a stored one, else a recent one.
    fn on_vertices(&mut self, codes: [u8; 3]) -> Decoded<[u32; 3]> {
        let mut triangle = [0; 3];
        for (index, code) in triangle.iter_mut().zip(codes) {
            *index = match code {
                0 => self.new_index(),
                15 => 0,
                code => self.vertices.get(usize::from(code) - 1),
            };
        }
        for (index, code) in triangle.iter_mut().zip(codes) {
            if code == 15 {
                *index = self.stored()?;
            }
        }
        let [a, b, c] = triangle;
        for (index, code) in triangle.into_iter().zip(codes) {
            if matches!(code, 0 | 15) {
                self.vertices.push(index);
            }
        }
        for edge in [[b, a], [c, b], [a, c]] {
            self.edges.push(edge);
        }
        Ok(triangle)
    }
}

/// Decodes `count` indices, three for each triangle, to `size` bytes each, 2 or 4.
pub(in super::super) fn triangles(bytes: &[u8], count: usize, size: usize) -> Decoded<Vec<u8>> {
    let (&header, rest) = bytes.split_first().ok_or_else(truncated)?;
    let version = version(header, 0xe0, 1)?;
    let (codes, rest) = rest.split_at_checked(count / 3).ok_or_else(truncated)?;
    let (data, table) = rest.split_at_checked(rest.len().wrapping_sub(16)).ok_or_else(truncated)?;
    let limit = if version == 0 { 15 } else { 13 };
    let (edges, vertices) = (Recent::new([u32::MAX; 2]), Recent::new(u32::MAX));
    let mut state = Triangles { reader: Reader { rest: data }, edges, vertices, next: 0, last: 0 };
    let mut indices = Vec::with_capacity(count * size);
    for code in codes {
        let (high, low) = (code >> 4, code & 15);
        let triangle = match (high, low) {
            (15, 14 | 15) => {
                let pair = state.reader.byte()?;
                if pair == 0 {
                    state.next = 0;
                }
                state.on_vertices([if low == 14 { 0 } else { 15 }, pair >> 4, pair & 15])?
            }
            (15, entry) => {
                let pair = table[usize::from(entry)];
                state.on_vertices([0, pair >> 4, pair & 15])?
            }
            (edge, third) => state.on_edge(usize::from(edge), third, limit)?,
        };
        for index in triangle {
            indices.extend(&index.to_le_bytes()[..size]);
        }
    }
    state.reader.end()?;
    Ok(indices)
}

/// Decodes `count` indices to `size` bytes each, 2 or 4: differences to one of two last ones.
pub(in super::super) fn indices(bytes: &[u8], count: usize, size: usize) -> Decoded<Vec<u8>> {
    let (&header, rest) = bytes.split_first().ok_or_else(truncated)?;
    version(header, 0xd0, 1)?;
    let (data, _) = rest.split_at_checked(rest.len().wrapping_sub(4)).ok_or_else(truncated)?;
    if data.len() < count {
        return Err(truncated());
    }
    let mut reader = Reader { rest: data };
    let mut last = [0_u32; 2];
    let mut indices = Vec::with_capacity(count * size);
    for _ in 0..count {
        let value = reader.varint()?;
        let last = &mut last[(value & 1) as usize];
        *last = last.wrapping_add(unzigzag(value >> 1));
        indices.extend(&last.to_le_bytes()[..size]);
    }
    reader.end()?;
    Ok(indices)
}
