use std::time::Instant;
fn main() {
    for path in std::env::args().skip(1) {
        let t = Instant::now();
        let bytes = std::fs::read(&path).unwrap();
        let read = t.elapsed();
        let t = Instant::now();
        match glimpse::Scene::from_gltf(&bytes, &mut |u| Err(format!("no {u}"))) {
            Ok(s) => {
                let el = t.elapsed();
                let t = Instant::now();
                s.validate().unwrap();
                let v = t.elapsed();
                println!(
                    "{:28} tris {:8} obj {:4} mat {:3} tex {:2} img {:2} lights {} cams {:?} load {:.0} ms (validate {:.0}, read {:.0}) feats {:?}",
                    path.rsplit('/').next().unwrap(),
                    s.positions.len(),
                    s.objects.len(),
                    s.materials.len(),
                    s.textures.len(),
                    s.images.len(),
                    s.lights.len(),
                    s.cameras.iter().map(|c| &c.0).collect::<Vec<_>>(),
                    el.as_secs_f64() * 1e3,
                    v.as_secs_f64() * 1e3,
                    read.as_secs_f64() * 1e3,
                    glimpse::Features::of(&s).list().iter().filter(|f| f.1).map(|f| f.0).collect::<Vec<_>>()
                );
                for w in &s.warnings {
                    println!("      {w}");
                }
                println!("      {:?} bounds {:?}", s.environment, s.bounds());
            }
            Err(e) => println!("{path}: ERROR {e}"),
        }
    }
}
