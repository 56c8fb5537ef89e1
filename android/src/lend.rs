//! The setup of the session on Android.

use android_activity::AndroidApp;
use glimpse_app::{AtRest, Choices};
use glimpse_shell::{Setup, free_name};

use crate::{
    files::{self, Names},
    java::Intent,
};

/// For the scene that the intent names, and frames of `view` pixels at full resolution.
pub fn setup(android: &AndroidApp, names: &Names, intent: &Intent, view: [u32; 2]) -> Setup {
    let scene = match (&intent.uri, &intent.scene) {
        (Some(uri), _) => files::name(android, names, uri),
        (None, Some(scene)) => scene.clone(),
        (None, None) => glimpse_app::scenes().next().unwrap_or_default(),
    };
    let folder = android.external_data_path().or_else(|| android.internal_data_path());
    Setup {
        files: files::reader(android, names),
        scene,
        recent: files::assets(android),
        cached_kernels: Vec::new(),
        // What refinement costs has been measured on no phone.
        choices: Choices { at_rest: AtRest::Chosen, ..Choices::default() },
        adapter: None,
        limits: None,
        screen: None,
        view: Some(view),
        size: view,
        script: None,
        save: Box::new(move |_, picture| {
            let folder = folder.as_ref().ok_or("there is no folder for pictures")?;
            let file = free_name(folder).ok_or("there is no free name for a picture")?;
            let png = glimpse::to_png(picture).map_err(|error| error.to_string())?;
            std::fs::write(&file, png).map_err(|error| format!("{}: {error}", file.display()))?;
            Ok(format!("Saved {}", file.display()))
        }),
        compare: Box::new(|_, _, _| Err("expected no picture to compare with on a phone".to_owned())),
        print: Box::new(|line| {
            log::info!("{line}");
            Ok(())
        }),
        // Permissions for other apps' files end with this process, and the package's scenes are always listed.
        remember: Box::new(|_| ()),
        // GPUs compile kernels without holding up their queue.
        keep_kernels: Box::new(|_| ()),
    }
}
