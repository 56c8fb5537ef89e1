//! Reads scenes by name: built-in ones, assets of the package, and files of other apps.

use std::{
    collections::HashMap,
    ffi::CString,
    fs::File,
    io::Read,
    os::fd::FromRawFd,
    sync::{Arc, Mutex, PoisonError},
};

use android_activity::AndroidApp;
use glimpse::{Scene, scene};
use glimpse_app::Files;

use crate::java;

/// Content URIs that this process was given, by the display names of their files.
pub type Names = Arc<Mutex<HashMap<String, String>>>;

/// Registers a content URI; returns the name by which its file can be opened.
pub fn name(app: &AndroidApp, names: &Names, uri: &str) -> String {
    let told = java::display_name(app, uri).unwrap_or_else(|error| {
        log::info!("{uri} has no name: {error}");
        None
    });
    let last = uri.rsplit('/').next().unwrap_or(uri);
    let name = told.unwrap_or_else(|| last.to_owned());
    names.lock().unwrap_or_else(PoisonError::into_inner).insert(name.clone(), uri.to_owned());
    name
}

/// Names of the scenes in the package, as `asset:NAME`.
pub fn assets(app: &AndroidApp) -> Vec<String> {
    let mut names = Vec::new();
    if let Some(mut folder) = app.asset_manager().open_dir(c"scenes") {
        while let Some(name) = folder.with_next(|name| name.to_string_lossy().into_owned()) {
            names.push(format!("asset:{name}"));
        }
    }
    names.sort();
    names
}

/// The reader of scenes for the session; it may be called on any thread.
pub fn reader(app: &AndroidApp, names: &Names) -> Files {
    let (app, names) = (app.clone(), names.clone());
    Arc::new(move |name| {
        load(&app, &names, name).map(Into::into).map_err(|reason| format!("{name}: {reason}"))
    })
}

fn load(app: &AndroidApp, names: &Names, name: &str) -> Result<Scene, String> {
    if let Some(builtin) = name.strip_prefix("builtin:") {
        return scene::builtin(builtin)
            .ok_or_else(|| format!("no such scene; there are {}", scene::BUILTIN_NAMES.join(", ")));
    }
    let bytes = match name.strip_prefix("asset:") {
        Some(asset) => read_asset(app, asset)?,
        None => {
            let uri = names.lock().unwrap_or_else(PoisonError::into_inner).get(name).cloned();
            read_content(app, &uri.unwrap_or_else(|| name.to_owned()))?
        }
    };
    let mut alone = |uri: &str| {
        Err(format!(
            "expected a .glb with everything in it, found a scene that needs the file `{uri}` beside it"
        ))
    };
    Scene::from_gltf(&bytes, &mut alone).map_err(|error| error.to_string())
}

fn read_asset(app: &AndroidApp, name: &str) -> Result<Vec<u8>, String> {
    let path = CString::new(format!("scenes/{name}")).map_err(|error| error.to_string())?;
    let missing = || format!("no such scene in the package; there are {}", assets(app).join(", "));
    let mut asset = app.asset_manager().open(&path).ok_or_else(missing)?;
    asset.buffer().map(<[u8]>::to_vec).map_err(|error| format!("cannot be read: {error}"))
}

fn read_content(app: &AndroidApp, uri: &str) -> Result<Vec<u8>, String> {
    let descriptor = java::open(app, uri).map_err(|error| format!("cannot be read: {error}"))?;
    if descriptor < 0 {
        return Err("cannot be read: its owner gives no file".to_owned());
    }
    #[allow(unsafe_code, reason = "Java gave the descriptor away")]
    // SAFETY: the descriptor is open, and owned by this file alone.
    let mut file = unsafe { File::from_raw_fd(descriptor) };
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|error| format!("cannot be read: {error}"))?;
    Ok(bytes)
}
