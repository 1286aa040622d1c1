use super::*;

const SQUARE: &[u8] = include_bytes!("../../../../fuzz/seeds/gltf/square");
const BINARY: &[u8] = include_bytes!("../../../../fuzz/seeds/gltf/binary");

fn said(text: &str) -> String {
    Mesh::of_gltf(text.as_bytes()).unwrap_err().to_string()
}

fn text() -> String {
    String::from_utf8(SQUARE.to_vec()).unwrap()
}

#[test]
fn a_square_is_two_triangles_where_its_node_is() {
    for bytes in [SQUARE, BINARY] {
        let mesh = Mesh::of_gltf(bytes).unwrap();
        assert_eq!(mesh.len(), 2);
        // A unit square around the origin, twice as large, moved by 3 along x.
        assert!((mesh.centre() - DVec3::new(3.0, 0.0, 0.0)).length() < 1e-9, "{}", mesh.centre());
        assert!((mesh.radius() - 2.0_f64.sqrt()).abs() < 1e-9, "{}", mesh.radius());
    }
}

#[test]
fn what_leads_nowhere_is_refused() {
    let circle = text().replace("\"mesh\":0", "\"mesh\":0,\"children\":[0]");
    assert!(said(&circle).contains("none within itself"), "{}", said(&circle));
    let long = text().replace("\"count\":6", "\"count\":600");
    assert!(said(&long).contains("accessors within their buffers"), "{}", said(&long));
    let far = text().replace("\"byteOffset\":48", "\"byteOffset\":18446744073709551615");
    assert!(said(&far).contains("accessors within their buffers"), "{}", said(&far));
    // As bytes, every other index is 0.
    let flat = text().replace("\"componentType\":5123", "\"componentType\":5121");
    assert!(said(&flat).contains("triangles with an area"), "{}", said(&flat));
    let other = text().replace("\"componentType\":5123", "\"componentType\":5126");
    assert!(said(&other).contains("an accessor of"), "{}", said(&other));
}

#[test]
fn nodes_that_share_an_empty_mesh_end_somewhere() {
    let primitive = "{\"attributes\":{\"POSITION\":0},\"indices\":1}";
    let points = "{\"attributes\":{\"POSITION\":0},\"mode\":0}";
    let node = "{\"mesh\":0,\"translation\":[3,0,0],\"scale\":[2,2,2]}";
    let places = (0..5000).map(|node| node.to_string()).collect::<Vec<_>>().join(",");
    let many = text().replace(primitive, &[points; 64].join(",")).replace(node, &["{\"mesh\":0}"; 5000].join(","));
    let many = many.replace("\"nodes\":[0]", &format!("\"nodes\":[{places}]"));
    assert!(said(&many).contains("primitives in all nodes"), "{}", said(&many));
}

#[test]
fn buffers_lie_beside_the_file_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let start = text().find("data:").unwrap();
    let end = start + text()[start..].find('"').unwrap();
    let file = |uri: &str| {
        let mut elsewhere = text();
        elsewhere.replace_range(start..end, uri);
        let path = folder.path().join("a.gltf");
        std::fs::write(&path, elsewhere).unwrap();
        Mesh::load(&path).map_err(|error| error.to_string())
    };
    std::fs::write(folder.path().join("a b.bin"), [0; 60]).unwrap();
    assert!(file("a%20b.bin").unwrap_err().contains("triangles with an area"));
    assert!(file("none.bin").unwrap_err().contains("its buffer 'none.bin' beside it"));
    for elsewhere in ["../a.bin", "/etc/hostname", "%2e%2e/a.bin"] {
        let why = file(elsewhere).unwrap_err();
        assert!(why.contains("a.gltf") && why.contains("buffers beside the file"), "{why}");
    }
}

#[test]
fn strips_and_fans_are_triangles() {
    assert_eq!(faces(&[0, 1, 2, 3], Mode::TriangleStrip), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(faces(&[0, 1, 2, 3], Mode::TriangleFan), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(faces(&[0, 1, 2, 3], Mode::Triangles), [[0, 1, 2]]);
    assert!(faces(&[], Mode::TriangleFan).is_empty());
}
