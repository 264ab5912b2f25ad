//! glTF 2.0 and its binary form, GLB: the triangles of the scene's nodes, put where the nodes are.

use gltf::json::Root;
use gltf::json::validation::Checked;
use gltf::mesh::Mode;
use gltf::{Document, Node, Semantic};

use super::build::Builder;
use super::error::MeshError;
use super::gltf_data::{Buffers, indices, places};
use super::{Fetch, MOST_BYTES};

/// Objects in the JSON at most: each may take hundreds of bytes of memory.
const MOST_OBJECTS: usize = 200_000;

/// Items of lists in the JSON at most.
const MOST_ITEMS: usize = 4_000_000;

/// Primitives that nodes may show, all told: those that add nothing take time, too.
const MOST_SHOWN: usize = 1_000_000;

/// Rows of an affine transform.
type Rows = [[f64; 4]; 3];

const IDENTITY: Rows = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

/// Reads a GLB: a header, a chunk of JSON, and perhaps one of bytes.
pub(super) fn read_binary(
    bytes: &[u8],
    fetch: &mut Fetch,
    notes: &mut Vec<String>,
) -> Result<Builder, MeshError> {
    let wrong = |what: &str| MeshError::new(what, "a GLB file, binary glTF of version 2");
    let Some(rest) = bytes.strip_prefix(b"glTF") else {
        return Err(wrong("the file does not begin with `glTF`").at_byte(0));
    };
    let word = |bytes: &[u8]| bytes.first_chunk().map(|it| u32::from_le_bytes(*it));
    let version = word(rest).ok_or_else(|| wrong("the file ends in its header"))?;
    if version != 2 {
        return Err(wrong(&format!("it is of version {version}")).at_byte(4));
    }
    let mut rest = rest.get(8..).unwrap_or_default();
    let byte_of = |rest: &[u8]| bytes.len() - rest.len();
    let (mut json, mut binary) = (None, None);
    while !rest.is_empty() {
        let length = word(rest).map(|length| length as usize);
        let kind = rest.get(4..8);
        let chunk = length.and_then(|length| rest.get(8..)?.get(..length));
        let (Some(kind), Some(chunk)) = (kind, chunk) else {
            let error = wrong("the file ends in the middle of a chunk");
            return Err(error.at_byte(byte_of(rest)));
        };
        match kind {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        rest = &rest[8 + chunk.len()..];
    }
    let json = json.ok_or_else(|| wrong("it has no chunk of JSON"))?;
    read(json, binary, fetch, notes).map_err(|error| match (error.line, error.column) {
        // Lines of a part of the file are no lines of the file.
        (Some(line), Some(column)) => MeshError {
            line: None,
            column: None,
            within: Some(format!("line {line}, column {column} of its JSON")),
            ..error
        },
        _ => error,
    })
}

/// Reads glTF's JSON; `binary` is the chunk of bytes beside it.
pub(super) fn read(
    json: &[u8],
    binary: Option<&[u8]>,
    fetch: &mut Fetch,
    notes: &mut Vec<String>,
) -> Result<Builder, MeshError> {
    let document = document(json)?;
    let mut buffers = Buffers::new(binary, MOST_BYTES);
    let mut built = Builder::default();
    let (mut shown, mut skipped) = (0, 0);
    // A node may have one parent, so each is met once; one met again is in a circle.
    let mut met = vec![false; document.nodes().len()];
    let roots: Vec<Node> = match document.default_scene().or(document.scenes().next()) {
        Some(scene) => scene.nodes().collect(),
        None => return Err(MeshError::new("it has no scene", "a scene with nodes")),
    };
    let mut waiting: Vec<(Node, Rows)> = roots.into_iter().map(|it| (it, IDENTITY)).collect();
    // In the order of the file.
    waiting.reverse();
    while let Some((node, world_from_parent)) = waiting.pop() {
        if std::mem::replace(&mut met[node.index()], true) {
            let error = MeshError::new("the node has more than one parent", "a tree of nodes");
            return Err(error.within(|| format!("nodes[{}]", node.index())));
        }
        let world_from_node = after(&world_from_parent, &rows_of(&node));
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                shown += 1;
                if shown > MOST_SHOWN {
                    let what = format!("its nodes show more than {MOST_SHOWN} primitives");
                    let error = MeshError::new(what, "fewer nodes, or fewer primitives a mesh");
                    return Err(error.within(|| format!("nodes[{}]", node.index())));
                }
                if !matches!(
                    primitive.mode(),
                    Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
                ) {
                    skipped += 1;
                    continue;
                }
                let group = node.name().or(mesh.name()).unwrap_or_default();
                let material = primitive.material();
                built.part(group, material.name().unwrap_or_default())?;
                let done = primitive_of(
                    &primitive,
                    &world_from_node,
                    &mut buffers,
                    fetch,
                    &mut built,
                );
                let place =
                    || format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
                done.map_err(|error| error.within(place))?;
            }
        }
        let children: Vec<Node> = node.children().collect();
        let children = children.into_iter().rev();
        waiting.extend(children.map(|child| (child, world_from_node)));
    }
    if skipped > 0 {
        notes.push(match skipped {
            1 => "1 set of points or lines is left out".to_owned(),
            _ => format!("{skipped} sets of points or lines are left out"),
        });
    }
    Ok(built)
}

/// The JSON, of bounded size, read and found to be in order.
fn document(json: &[u8]) -> Result<Document, MeshError> {
    let count = |mark: u8| json.iter().filter(|byte| **byte == mark).count();
    if count(b'{') > MOST_OBJECTS || count(b',') > MOST_ITEMS {
        let what = "its JSON has too many objects or items";
        return Err(MeshError::new(what, "numbers in buffers, and fewer nodes"));
    }
    let root = Root::from_slice(json).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let whole = error.to_string();
        let why = whole.split(" at line ").next().unwrap_or_default();
        let why: String = why.chars().take(200).collect();
        MeshError::new(
            format!("it is not glTF's JSON: {why}"),
            "glTF 2.0 as modelling programs write it",
        )
        .at_column(line.max(1), column.max(1))
    })?;
    // The library looks these up before it has found that they are there.
    let positions = Checked::Valid(Semantic::Positions);
    let primitives = root.meshes.iter().enumerate();
    let primitives = primitives.flat_map(|(mesh, of)| {
        let numbered = of.primitives.iter().enumerate();
        numbered.map(move |(at, primitive)| (mesh, at, primitive))
    });
    for (mesh, at, primitive) in primitives {
        let accessor = primitive.attributes.get(&positions);
        if let Some(index) = accessor.filter(|it| it.value() >= root.accessors.len()) {
            let (index, count) = (index.value(), root.accessors.len());
            let what = format!("POSITION is accessor {index}, counted from 0, of {count}");
            let error = MeshError::new(what, "an accessor that is there");
            return Err(error.within(|| format!("meshes[{mesh}].primitives[{at}]")));
        }
    }
    Document::from_json(root).map_err(|error| match error {
        gltf::Error::Validation(errors) => {
            let first = errors.first();
            let what = first.map_or("it is not in order".into(), |(path, error)| {
                format!("`{path}`: {error}")
            });
            let what: String = what.chars().take(300).collect();
            MeshError::new(what, "glTF 2.0 without extensions that must be known")
        }
        error => MeshError::new(error.to_string(), "glTF 2.0 as modelling programs write it"),
    })
}

fn primitive_of(
    primitive: &gltf::Primitive,
    world_from_node: &Rows,
    buffers: &mut Buffers,
    fetch: &mut Fetch,
    built: &mut Builder,
) -> Result<(), MeshError> {
    let Some(positions) = primitive.get(&Semantic::Positions) else {
        let what = "triangles have no positions";
        return Err(MeshError::new(what, "an accessor of POSITION"));
    };
    let first = built.vertex_count();
    let count = positions.count();
    built.reserve(count)?;
    for (number, place) in places(&positions, buffers, fetch)?.enumerate() {
        let done = built.vertex(moved(world_from_node, place));
        let item = || format!("accessors[{}], item {number}", positions.index());
        done.map_err(|error| error.within(item))?;
    }
    let corners = match primitive.indices() {
        Some(accessor) => indices(&accessor, buffers, fetch)?,
        None => {
            let mut all = Vec::new();
            let reserved = all.try_reserve_exact(count);
            reserved.map_err(|_| MeshError::no_memory(count as u64, "indices"))?;
            // As many as vertices that are there.
            all.extend(0..count as u32);
            all
        }
    };
    if let Some(at) = corners.iter().find(|at| **at as usize >= count) {
        let what = format!("a triangle has the vertex {at}, counted from 0, of {count}");
        return Err(MeshError::new(what, "indices of vertices that are there"));
    }
    // What is mirrored runs the other way around.
    let is_mirrored = determinant(world_from_node) < 0.0;
    let mut triangle = |[a, b, c]: [u32; 3]| {
        let corners = if is_mirrored { [a, c, b] } else { [a, b, c] };
        built.polygon(&corners.map(|at| at + first as u32))
    };
    match primitive.mode() {
        Mode::TriangleStrip => {
            for (at, three) in corners.windows(3).enumerate() {
                let [a, b, c] = [three[0], three[1], three[2]];
                triangle(if at % 2 == 0 { [a, b, c] } else { [b, a, c] })?;
            }
        }
        Mode::TriangleFan => {
            for pair in corners.get(1..).unwrap_or_default().windows(2) {
                triangle([corners[0], pair[0], pair[1]])?;
            }
        }
        _ => {
            let (triangles, rest) = corners.as_chunks::<3>();
            if !rest.is_empty() {
                let what = format!("{} corners are no multiple of 3", corners.len());
                return Err(MeshError::new(what, "3 for each triangle"));
            }
            for corners in triangles {
                triangle(*corners)?;
            }
        }
    }
    Ok(())
}

/// The rows of a node's own transform.
fn rows_of(node: &Node) -> Rows {
    let columns = node.transform().matrix();
    [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column: usize| f64::from(columns[column][row])))
}

/// The transform that does `second` after `first`.
fn after(second: &Rows, first: &Rows) -> Rows {
    [0, 1, 2].map(|row: usize| {
        [0, 1, 2, 3].map(|column: usize| {
            let [x, y, z, w] = second[row];
            let sum = x * first[0][column] + y * first[1][column] + z * first[2][column];
            if column == 3 { sum + w } else { sum }
        })
    })
}

fn moved(rows: &Rows, place: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = place.map(f64::from);
    rows.map(|row| (row[0] * x + row[1] * y + row[2] * z + row[3]) as f32)
}

fn determinant([a, b, c]: &Rows) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
