//! Peak memory of imports, for files that request a lot: measured against the bound stated by the importer. A
//! binary with a single test, as every allocation of the process counts.

use glimpse::{Scene, scene::ImportOptions};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use peak_alloc::PeakAlloc;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What an import takes besides what its file requests.
const FIXED: usize = 8 << 20;

/// A file, and what it requests beyond its own bytes.
struct Case {
    name: &'static str,
    file: Vec<u8>,
    /// Content of the one external file.
    external: Vec<u8>,
    triangles_and_objects: usize,
    texels: usize,
    /// Bytes that compressed buffer views and meshes decode to.
    decoded: usize,
    /// Triangles of the largest object whose tangents are computed.
    tangents: usize,
}

impl Case {
    fn new(name: &'static str, file: Vec<u8>) -> Self {
        Self {
            name,
            file,
            external: Vec::new(),
            triangles_and_objects: 0,
            texels: 0,
            decoded: 0,
            tangents: 0,
        }
    }

    /// Upper bound on the memory, as stated in `core/src/scene/gltf/mod.rs`.
    fn bound(&self) -> usize {
        let json = match self.file.get(12..16).and_then(|word| word.try_into().ok()) {
            Some(word) if self.file.starts_with(b"glTF") => u32::from_le_bytes(word) as usize,
            _ => self.file.len(),
        };
        let all_else = self.file.len() - json + self.external.len();
        let shown =
            256 * self.triangles_and_objects + 16 * self.texels + 4 * self.decoded + 1024 * self.tangents;
        (8 << 20) + 1024 * json + 8 * all_else + shown
    }

    /// Peak of allocated bytes, and the result of the import.
    fn measured(&self, budget: Option<usize>) -> (usize, glimpse::Result<usize>) {
        let external = &self.external;
        let options = ImportOptions { memory: budget.map(|bytes| bytes as u64), ..ImportOptions::default() };
        let before = ALLOCATOR.current_usage();
        ALLOCATOR.reset_peak_usage();
        let scene = Scene::from_gltf_with(&self.file, &mut |_| Ok(external.clone()), &options);
        (ALLOCATOR.peak_usage() - before, scene.map(|scene| scene.positions.len()))
    }
}

fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let text = json.to_owned() + &" ".repeat(json.len().next_multiple_of(4) - json.len());
    let words = |words: &[usize]| words.iter().flat_map(|w| (*w as u32).to_le_bytes()).collect::<Vec<_>>();
    let header = words(&[2, 12 + 8 + text.len() + 8 + binary.len(), text.len()]);
    let parts: [&[u8]; 6] = [b"glTF", &header, b"JSON", text.as_bytes(), &words(&[binary.len()]), b"BIN\0"];
    [parts.concat(), binary.to_vec()].concat()
}

/// A file with a triangle in the `BIN` chunk, the given JSON members, and further binary data.
fn with(members: &str, more_binary: &[u8]) -> Vec<u8> {
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut binary: Vec<u8> = corners.iter().flat_map(|x| x.to_le_bytes()).collect();
    binary.extend(more_binary);
    let json =
        format!(r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],{members}}}"#, binary.len());
    glb(&json, &binary)
}

const TRIANGLE: &str = r#""accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
    "bufferViews":[{"buffer":0,"byteLength":36}]"#;
const MESH: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;

/// Files of many small elements, which need most memory as JSON.
fn elements() -> Vec<Case> {
    let many = |count: usize, element: &str| vec![element; count].join(",");
    let list = |name: &'static str, member: &str, element: &str| {
        let file = with(
            &format!(r#"{TRIANGLE},{MESH},"nodes":[{{"mesh":0}}],"{member}":[{}]"#, many(263_000, element)),
            &[],
        );
        Case { triangles_and_objects: 2, ..Case::new(name, file) }
    };
    let chain: Vec<_> = (1..100_000).map(|i| format!(r#"{{"children":[{i}]}}"#)).collect();
    let chain = with(&format!(r#"{TRIANGLE},{MESH},"nodes":[{},{{"mesh":0}}]"#, chain.join(",")), &[]);
    let nodes = with(&format!(r#"{TRIANGLE},{MESH},"nodes":[{}]"#, many(263_000, "{}")), &[]);
    let twice = format!(r#""scenes":[{{"nodes":[{}]}}],"nodes":[{{"mesh":0}}]"#, many(1_000_000, "0"));
    let extras = format!(
        r#""scenes":[{{"nodes":[0],"extras":{{"background":[{}]}}}}],"nodes":[{{}}]"#,
        many(1_000_000, "0")
    );
    vec![
        list("materials", "materials", "{}"),
        list("textures", "textures", "{}"),
        list("images", "images", "{}"),
        list("samplers", "samplers", "{}"),
        list("cameras", "cameras", r#"{"type":"perspective"}"#),
        list("unknown members", "unknown", "[]"),
        Case { triangles_and_objects: 2, ..Case::new("a chain of nodes", chain) },
        Case::new("empty nodes", nodes),
        Case::new("a node listed a million times", with(&twice, &[])),
        Case::new("long extras", with(&extras, &[])),
    ]
}

/// Files that reference one of their parts many times.
fn sharing() -> Vec<Case> {
    let repeated = |count: usize, element: &str| vec![element; count].join(",");
    let buffer = r#"{"byteLength":36,"uri":"a.bin"}"#;
    let buffers = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{}],{TRIANGLE},{MESH},"nodes":[{{"mesh":0}}]}}"#,
        repeated(10_000, buffer)
    );
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut external: Vec<u8> = corners.iter().flat_map(|x| x.to_le_bytes()).collect();
    external.resize(4 << 20, 0);

    const VALUES: u32 = 1 << 16;
    let indices: Vec<u8> = (0..VALUES).flat_map(u32::to_le_bytes).collect();
    let accessor = format!(
        r#"{{"componentType":5121,"type":"VEC3","count":{VALUES},"sparse":{{"count":{VALUES},
        "indices":{{"bufferView":0,"componentType":5125}},"values":{{"bufferView":1}}}}}}"#
    );
    let primitives: Vec<_> =
        (0..1000).map(|i| format!(r#"{{"attributes":{{"POSITION":{i}}},"mode":5}}"#)).collect();
    let sparse = format!(
        r#""bufferViews":[{{"buffer":0,"byteOffset":36,"byteLength":{}}},{{"buffer":0,"byteOffset":36,"byteLength":{}}}],
        "accessors":[{}],"meshes":[{{"primitives":[{}]}}],"nodes":[{{"mesh":0}}]"#,
        4 * VALUES, 3 * VALUES, repeated(1000, &accessor), primitives.join(",")
    ).replace(r#""nodes":[{}]"#, r#""nodes":[{"mesh":0}]"#);

    let long = "x".repeat(100_000);
    let named = format!(
        r#"{TRIANGLE},"meshes":[{{"name":"{long}","primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{}]"#,
        repeated(20_000, r#"{"mesh":0}"#)
    );
    let textured = format!(
        r#"{TRIANGLE},"meshes":[{{"primitives":[{}]}}],"nodes":[{}],"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],"textures":[{{}}]"#,
        repeated(100, r#"{"attributes":{"POSITION":0},"material":0}"#),
        repeated(1000, r#"{"mesh":0}"#)
    );
    vec![
        Case { external, triangles_and_objects: 2, ..Case::new("buffers of one URI", buffers.into_bytes()) },
        Case {
            triangles_and_objects: 1000 * VALUES as usize / 1000,
            ..Case::new("shared sparse values", with(&sparse, &indices))
        },
        Case {
            triangles_and_objects: 2,
            texels: 1,
            ..Case::new("a colour profile of 64 MiB", with_image(&profiled(64 << 20)))
        },
        Case { triangles_and_objects: 40_000, ..Case::new("instances of a long name", with(&named, &[])) },
        Case { triangles_and_objects: 200_000, ..Case::new("instances with warnings", with(&textured, &[])) },
    ]
}

/// Files whose small parts stand for many joints, instances or compressed bytes.
fn posed_and_compressed() -> Vec<Case> {
    let zeros = |count: usize| {
        format!(
            r#"{{"componentType":5126,"type":"VEC3","count":{count},"sparse":{{"count":1,
            "indices":{{"bufferView":0,"componentType":5121}},"values":{{"bufferView":0}}}}}}"#
        )
    };
    const INSTANCES: usize = 1 << 20;
    let instanced = format!(
        r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},{}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],{MESH},"nodes":[{{"mesh":0,
        "extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":1}}}}}}}}]"#,
        zeros(INSTANCES)
    );
    let joints = format!(
        r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},
        {{"bufferView":1,"componentType":5121,"type":"VEC4","count":3}},
        {{"bufferView":1,"componentType":5126,"type":"VEC4","count":3}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":48}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}}}]}}],
        "nodes":[{{"mesh":0,"skin":0}}],"skins":[{{"joints":[{}]}}]"#,
        vec!["0"; 1_000_000].join(",")
    );
    // Blocks of 256 elements of zeros, three bytes each.
    const ELEMENTS: usize = 1 << 22;
    let mut stream = vec![0xa1];
    stream.resize(1 + ELEMENTS / 256 * 3, 0xaa);
    stream.resize(stream.len() + 24, 0);
    let compressed = format!(
        r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{ELEMENTS}}},
        {{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3}}],
        "bufferViews":[{{"buffer":0,"byteLength":0,"extensions":{{"EXT_meshopt_compression":{{"buffer":0,
        "byteOffset":36,"byteLength":{},"byteStride":12,"count":{ELEMENTS},"mode":"ATTRIBUTES"}}}}}},
        {{"buffer":0,"byteLength":36}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"nodes":[{{"mesh":0}}]"#,
        stream.len()
    );
    vec![
        Case {
            triangles_and_objects: 2 * INSTANCES,
            ..Case::new("a million instances", with(&instanced, &[]))
        },
        Case { triangles_and_objects: 2, ..Case::new("a million joints", with(&joints, &[0; 48])) },
        Case {
            triangles_and_objects: 2,
            decoded: 12 * ELEMENTS,
            ..Case::new("compressed zeros", with(&compressed, &stream))
        },
    ]
}

fn with_image(bytes: &[u8]) -> Vec<u8> {
    let image = format!(
        r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{}}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],"nodes":[{{"mesh":0}}],
            "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
            "textures":[{{"source":0}}],"images":[{{"bufferView":1}}]"#,
        bytes.len()
    );
    with(&image, bytes)
}

/// Files that exceed the limits: nothing may be allocated for their requests.
fn greed() -> Vec<Case> {
    let accessor = |count: &str| {
        with(
            &format!(
                r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":{count}}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],{MESH},"nodes":[{{"mesh":0}}]"#
            ),
            &[],
        )
    };
    let empty = r#""accessors":[{"componentType":5126,"type":"VEC3","count":1000000000,"sparse":{"count":1,
        "indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}],
        "bufferViews":[{"buffer":0,"byteLength":36}]"#;
    let zeros = with(&format!(r#"{empty},{MESH},"nodes":[{{"mesh":0}}]"#), &[]);
    let instances = format!(
        r#""accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},
        {{"bufferView":1,"componentType":5121,"type":"SCALAR","count":300000}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":300000}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":5}}]}}],"nodes":[{}]"#,
        vec![r#"{"mesh":0}"#; 1000].join(",")
    );
    let instances = with(&instances, &[0, 1, 2].repeat(100_000));
    // A mesh of Draco: version 2.2, sequential, 2^31 triangles and as many points.
    let draco = b"DRACO\x02\x02\x01\x00\x00\x00\x80\x80\x80\x80\x08\x80\x80\x80\x80\x08\x01\0\0\0";
    let compressed = format!(
        r#""accessors":[{{"componentType":5126,"type":"VEC3","count":3}}],
        "bufferViews":[{{"buffer":0,"byteOffset":36,"byteLength":{}}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"extensions":{{"KHR_draco_mesh_compression":
        {{"bufferView":0,"attributes":{{"POSITION":0}}}}}}}}]}}]"#,
        draco.len()
    );
    vec![
        Case::new("2^31 triangles of Draco", with(&compressed, draco)),
        Case::new("a count of 10^9", accessor("1000000000")),
        Case::new("a count of 2^64 - 1", accessor("18446744073709551615")),
        Case::new("10^9 zeros", zeros),
        Case::new("10^8 triangles by instances", instances),
        Case::new("a PNG that says 16384 x 16384", with_image(&png_that_says(16_384))),
        Case::new("a PNG that says 2^31 - 1 squared", with_image(&png_that_says(i32::MAX as u32))),
    ]
}

/// Well-formed files, with the memory that each may take.
fn honest() -> Vec<Case> {
    const SIDE: u32 = 200;
    let corner = |i: u32| [(i % SIDE) as f32, (i / SIDE) as f32, 0.0];
    let corners: Vec<u8> = (0..SIDE * SIDE).flat_map(corner).flat_map(f32::to_le_bytes).collect();
    let cell = |i: u32| [i, i + 1, i + SIDE, i + SIDE, i + 1, i + SIDE + 1];
    let indices: Vec<u8> = (0..SIDE * (SIDE - 1) - 1).flat_map(cell).flat_map(u32::to_le_bytes).collect();
    let grid = format!(
        r#""accessors":[{{"bufferView":1,"componentType":5126,"type":"VEC3","count":{vertices}}},
        {{"bufferView":1,"componentType":5126,"type":"VEC2","count":{vertices}}},
        {{"bufferView":1,"componentType":5121,"type":"VEC4","count":{vertices},"normalized":true}},
        {{"bufferView":2,"componentType":5125,"type":"SCALAR","count":{count}}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{bytes},"byteStride":12}},
        {{"buffer":0,"byteOffset":{after},"byteLength":{index_bytes}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":0,"TEXCOORD_0":1,"COLOR_0":2}},"indices":3,"material":0}}]}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
        "textures":[{{"source":0}}],"images":[{{"uri":"a.png"}}],"nodes":[{}]"#,
        [r#"{"mesh":0}"#; 10].join(","),
        vertices = SIDE * SIDE,
        count = indices.len() / 4,
        bytes = corners.len(),
        after = 36 + corners.len(),
        index_bytes = indices.len(),
    );
    let triangles = 10 * indices.len() / 12;
    let (side, image) = (2048, encoded(2048));
    let bumpy = grid.replace(
        r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0}}"#,
        r#""normalTexture":{"index":0}"#,
    );
    assert_ne!(bumpy, grid);
    let binary = [corners, indices].concat();
    let (file, bumpy) = (with(&grid, &binary), with(&bumpy, &binary));
    let mapped = Case {
        external: image.clone(),
        triangles_and_objects: triangles + 10,
        texels: side * side,
        tangents: triangles / 10,
        ..Case::new("ten grids with a normal map", bumpy)
    };
    vec![
        mapped,
        Case {
            external: image,
            triangles_and_objects: triangles + 10,
            texels: side * side,
            ..Case::new("ten grids with a texture", file)
        },
    ]
}

fn encoded(side: u32) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::DynamicImage::new_rgba16(side, side).write_to(&mut bytes, image::ImageFormat::Png).expect("a PNG");
    bytes.into_inner()
}

/// A PNG of one texel with a colour profile of `bytes` zeros.
fn profiled(bytes: usize) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = PngEncoder::new(&mut file);
    encoder.set_icc_profile(vec![0; bytes]).expect("PNG has colour profiles");
    encoder.write_image(&[0; 4], 1, 1, ExtendedColorType::Rgba8).expect("a PNG");
    file
}

/// A PNG whose header claims another size, with a valid checksum (PNG, annex D).
fn png_that_says(side: u32) -> Vec<u8> {
    let mut bytes = encoded(1);
    bytes[16..20].copy_from_slice(&side.to_be_bytes());
    bytes[20..24].copy_from_slice(&side.to_be_bytes());
    let crc = bytes[12..29].iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| crc >> 1 ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 })
    });
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

#[test]
fn an_import_stays_below_its_bound() {
    let mut worst = 0.0_f64;
    for (group, scenes) in [
        (elements(), None),
        (sharing(), None),
        (posed_and_compressed(), None),
        (greed(), Some(false)),
        (honest(), Some(true)),
    ] {
        for case in group {
            let (peak, result) = case.measured(None);
            let (name, bound) = (case.name, case.bound());
            println!("{name}: {peak} of {bound} bytes, file of {}", case.file.len());
            assert!(peak <= bound, "{name}: {peak} bytes, the bound is {bound}");
            assert!(scenes.is_none_or(|expected| result.is_ok() == expected), "{name}: {result:?}");
            worst = worst.max(peak as f64 / bound as f64);

            let (within, same) = case.measured(Some(bound + FIXED));
            assert_eq!(same.ok(), result.ok(), "{name}: with its bound as the budget");
            assert!(within <= bound, "{name}: {within} bytes with a budget");
            // A budget that is too small is kept to, whatever the file requests.
            let budget = bound / 16;
            let (within, refused) = case.measured(Some(budget));
            assert!(within <= budget + FIXED, "{name}: {within} bytes, the budget is {budget}: {refused:?}");
        }
    }
    assert!(worst > 0.25, "the bound is of the size of what it bounds: {worst}");
}
