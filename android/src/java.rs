//! Calls into Java through JNI, without Java classes of the app: intent, content URIs, system bars, cutouts and
//! clipboard.

use android_activity::AndroidApp;
use jni::{
    Env, JavaVM,
    objects::JString,
    refs::{Global, Reference},
};

mod bound {
    #![allow(missing_docs, reason = "made by the macro")]
    #![allow(unsafe_code, reason = "made by the macro")]

    jni::bind_java_type! { pub Uri => "android.net.Uri", methods {
        fn to_java_string { name = "toString", sig = () -> JString },
        static fn parse(text: JString) -> Uri,
    } }
    jni::bind_java_type! { pub Parcelable => "android.os.Parcelable" }
    jni::bind_java_type! { pub Intent => "android.content.Intent",
        type_map { Uri => "android.net.Uri", Parcelable => "android.os.Parcelable" },
        methods {
            fn get_action() -> JString,
            fn get_data() -> Uri,
            fn get_parcelable_extra(name: JString) -> Parcelable,
            fn get_string_extra(name: JString) -> JString,
        }
    }
    jni::bind_java_type! { pub Cursor => "android.database.Cursor", methods {
        fn move_to_first() -> bool,
        fn get_string(column: i32) -> JString,
        fn close(),
    } }
    jni::bind_java_type! { pub ParcelFileDescriptor => "android.os.ParcelFileDescriptor", methods {
        fn detach_fd() -> i32,
    } }
    jni::bind_java_type! { pub ContentResolver => "android.content.ContentResolver",
        type_map {
            Uri => "android.net.Uri",
            Cursor => "android.database.Cursor",
            ParcelFileDescriptor => "android.os.ParcelFileDescriptor",
        },
        methods {
            fn open_file_descriptor(uri: Uri, mode: JString) -> ParcelFileDescriptor,
            fn query(
                uri: Uri, projection: JString[], selection: JString, arguments: JString[], order: JString
            ) -> Cursor,
        }
    }
    jni::bind_java_type! { pub DisplayCutout => "android.view.DisplayCutout", methods {
        fn get_safe_inset_left() -> i32,
        fn get_safe_inset_top() -> i32,
        fn get_safe_inset_right() -> i32,
        fn get_safe_inset_bottom() -> i32,
    } }
    jni::bind_java_type! { pub WindowInsets => "android.view.WindowInsets",
        type_map { DisplayCutout => "android.view.DisplayCutout" },
        methods { fn get_display_cutout() -> DisplayCutout }
    }
    jni::bind_java_type! { pub View => "android.view.View",
        type_map { WindowInsets => "android.view.WindowInsets" },
        methods {
            fn set_system_ui_visibility(flags: i32),
            fn get_root_window_insets() -> WindowInsets,
        }
    }
    jni::bind_java_type! { pub Window => "android.view.Window",
        type_map { View => "android.view.View" },
        methods { fn get_decor_view() -> View }
    }
    jni::bind_java_type! { pub ClipData => "android.content.ClipData", methods {
        static fn new_plain_text(label: JCharSequence, text: JCharSequence) -> ClipData,
    } }
    jni::bind_java_type! { pub ClipboardManager => "android.content.ClipboardManager",
        type_map { ClipData => "android.content.ClipData" },
        methods { fn set_primary_clip(clip: ClipData) }
    }
    jni::bind_java_type! { pub Activity => "android.app.Activity",
        type_map {
            Intent => "android.content.Intent",
            ContentResolver => "android.content.ContentResolver",
            Window => "android.view.Window",
        },
        methods {
            fn get_intent() -> Intent,
            fn get_content_resolver() -> ContentResolver,
            fn get_window() -> Window,
            fn get_system_service(name: JString) -> JObject,
            fn finish(),
        }
    }
}

use bound::{Activity, ClipData, ClipboardManager, ParcelFileDescriptor, Uri};

/// The flags `View.SYSTEM_UI_FLAG_`: `FULLSCREEN`, `HIDE_NAVIGATION`, `IMMERSIVE_STICKY`, and the three `LAYOUT_` flags
/// that keep the window's size while the bars appear and disappear. Deprecated since API 30, but the only way on API
/// 28.
const IMMERSIVE: i32 = 0x4 | 0x2 | 0x1000 | 0x100 | 0x200 | 0x400;

/// The intent that started the activity.
#[derive(Debug, Default)]
pub struct Intent {
    /// Content URI of the file to open, of the actions `VIEW` and `SEND`.
    pub uri: Option<String>,
    /// The extra `scene`: name of the scene to open.
    pub scene: Option<String>,
    /// The extra `view`: size of frames at full resolution, as `2560x1440`.
    pub view: Option<String>,
    /// The extra `set`: changes of choices as in scripts, separated by semicolons.
    pub set: Option<String>,
}

/// Reads the intent that started the activity.
pub fn intent(app: &AndroidApp) -> Result<Intent, String> {
    call(app, |env, activity| {
        let intent = activity.get_intent(env)?;
        if intent.is_null() {
            return Ok(Intent::default());
        }
        let action = intent.get_action(env)?;
        let action = text(env, &action)?;
        let uri = match action.as_deref() {
            Some("android.intent.action.SEND") => {
                let name = env.new_string("android.intent.extra.STREAM")?;
                let stream = intent.get_parcelable_extra(env, &name)?;
                env.cast_local::<Uri>(stream)?
            }
            Some("android.intent.action.VIEW") => intent.get_data(env)?,
            _ => Uri::null(),
        };
        let uri = if uri.is_null() { JString::null() } else { uri.to_java_string(env)? };
        let uri = text(env, &uri)?;
        let mut extra = |name: &str| {
            let name = env.new_string(name)?;
            let found = intent.get_string_extra(env, &name)?;
            text(env, &found)
        };
        Ok(Intent { uri, scene: extra("scene")?, view: extra("view")?, set: extra("set")? })
    })
}

/// Opens a content URI for reading; returns a file descriptor that the caller has to close, -1 where the
/// provider returned none.
pub fn open(app: &AndroidApp, uri: &str) -> Result<i32, String> {
    call(app, |env, activity| {
        let resolver = activity.get_content_resolver(env)?;
        let (uri, mode) = (env.new_string(uri)?, env.new_string("r")?);
        let uri = Uri::parse(env, &uri)?;
        let descriptor: ParcelFileDescriptor = resolver.open_file_descriptor(env, &uri, &mode)?;
        if descriptor.is_null() {
            return Ok(-1);
        }
        descriptor.detach_fd(env)
    })
}

/// The display name of a content URI's file, where its provider has one.
pub fn display_name(app: &AndroidApp, uri: &str) -> Result<Option<String>, String> {
    call(app, |env, activity| {
        let resolver = activity.get_content_resolver(env)?;
        let uri = env.new_string(uri)?;
        let uri = Uri::parse(env, &uri)?;
        let column = env.new_string("_display_name")?;
        let columns = jni::objects::JObjectArray::<JString>::new(env, 1, &column)?;
        let nothing = jni::objects::JObjectArray::<JString>::null();
        let cursor = resolver.query(env, &uri, &columns, &JString::null(), &nothing, &JString::null())?;
        if cursor.is_null() {
            return Ok(None);
        }
        let name = if cursor.move_to_first(env)? {
            let name = cursor.get_string(env, 0)?;
            text(env, &name)?
        } else {
            None
        };
        cursor.close(env)?;
        Ok(name)
    })
}

/// Hides the system bars; returns the cutout's insets at the left, top, right and bottom in pixels. Must be called on
/// Java's main thread.
pub fn immerse(app: &AndroidApp) -> Result<[i32; 4], String> {
    call(app, |env, activity| {
        let window = activity.get_window(env)?;
        let view = window.get_decor_view(env)?;
        view.set_system_ui_visibility(env, IMMERSIVE)?;
        let insets = view.get_root_window_insets(env)?;
        if insets.is_null() {
            return Ok([0; 4]);
        }
        let cutout = insets.get_display_cutout(env)?;
        if cutout.is_null() {
            return Ok([0; 4]);
        }
        Ok([
            cutout.get_safe_inset_left(env)?,
            cutout.get_safe_inset_top(env)?,
            cutout.get_safe_inset_right(env)?,
            cutout.get_safe_inset_bottom(env)?,
        ])
    })
}

/// Copies a text to the clipboard. Must be called on Java's main thread.
pub fn copy(app: &AndroidApp, words: &str) -> Result<(), String> {
    call(app, |env, activity| {
        let (service, label, words) =
            (env.new_string("clipboard")?, env.new_string("Glimpse")?, env.new_string(words)?);
        let manager = activity.get_system_service(env, &service)?;
        let manager = env.cast_local::<ClipboardManager>(manager)?;
        let clip = ClipData::new_plain_text(env, &label, &words)?;
        manager.set_primary_clip(env, &clip)
    })
}

/// Finishes the activity, which is then destroyed. Must be called on Java's main thread.
pub fn finish(app: &AndroidApp) -> Result<(), String> {
    call(app, |env, activity| activity.finish(env))
}

/// Runs work on Java's main thread, without waiting for it.
pub fn on_main_thread(app: &AndroidApp, work: impl FnOnce(&AndroidApp) + Send + 'static) {
    let own = app.clone();
    app.run_on_java_main_thread(Box::new(move || work(&own)));
}

/// Calls Java with the activity object, on any thread. A Java exception is cleared and returned as an error.
fn call<T>(
    app: &AndroidApp,
    work: impl FnOnce(&mut Env<'_>, &Activity<'_>) -> jni::errors::Result<T>,
) -> Result<T, String> {
    #[allow(unsafe_code, reason = "android_activity gives its virtual machine as a pointer")]
    // SAFETY: the pointer is to the process's virtual machine, which lives as long as the process.
    let machine = unsafe { JavaVM::from_raw(app.vm_as_ptr().cast()) };
    let called = machine.attach_current_thread(|env| {
        env.with_local_frame(16, |env| {
            let raw: jni::sys::jobject = app.activity_as_ptr().cast();
            #[allow(unsafe_code, reason = "android_activity gives its activity as a pointer")]
            // SAFETY: a global reference that lives as long as `app` and is not freed here.
            let activity = unsafe { env.as_cast_raw::<Global<Activity<'_>>>(&raw)? };
            let done = work(env, &activity);
            match done {
                Err(jni::errors::Error::JavaException) => env.exception_catch().and(done),
                done => done,
            }
        })
    });
    called.map_err(|error: jni::errors::Error| match error {
        jni::errors::Error::CaughtJavaException { name, msg, .. } => format!("{name}: {msg}"),
        other => other.to_string(),
    })
}

fn text(env: &Env<'_>, string: &JString<'_>) -> jni::errors::Result<Option<String>> {
    if string.is_null() { Ok(None) } else { string.try_to_string(env).map(Some) }
}
