//! `android.app`, `android.content`, `android.net`, `android.os`: the activity, its intent, and what URIs lead to.

use std::fs::File;
use std::os::fd::IntoRawFd as _;
use std::sync::Mutex;

use std::sync::atomic::Ordering;

use super::super::class::{Call, Class, Constant, class, find, function, method};
use super::super::object::{Exception, Object, State, Value};
use super::super::world::{Content, with_world};
use super::Answer;
use super::view::on_main_thread;
use crate::sync::lock;

const OBJECT: &[&str] = &["java/lang/Object"];
const CONTEXT_WRAPPER: &[&str] = &["android/content/ContextWrapper"];

pub static CLASSES: &[Class] = &[
    Class {
        name: "android/content/Context",
        parents: OBJECT,
        methods: &[
            method("getSystemService", "(Ljava/lang/String;)Ljava/lang/Object;", system_service),
            method("getContentResolver", "()Landroid/content/ContentResolver;", content_resolver),
            method("getAssets", "()Landroid/content/res/AssetManager;", asset_manager),
        ],
        constants: &[
            Constant { name: "CLIPBOARD_SERVICE", value: "clipboard" },
            Constant { name: "INPUT_METHOD_SERVICE", value: "input_method" },
        ],
    },
    class("android/content/ContextWrapper", &["android/content/Context"], &[]),
    class("android/view/ContextThemeWrapper", CONTEXT_WRAPPER, &[]),
    class("android/app/Application", CONTEXT_WRAPPER, &[]),
    class(
        "android/app/Activity",
        &["android/view/ContextThemeWrapper"],
        &[
            method("getApplication", "()Landroid/app/Application;", application),
            method("finish", "()V", finish),
            method("getIntent", "()Landroid/content/Intent;", intent),
            method("getWindow", "()Landroid/view/Window;", window),
        ],
    ),
    class("android/app/NativeActivity", &["android/app/Activity"], &[]),
    class("android/content/res/AssetManager", OBJECT, &[]),
    class("android/os/Parcelable", OBJECT, &[]),
    class("android/os/IBinder", OBJECT, &[]),
    class(
        "android/content/Intent",
        &["java/lang/Object", "android/os/Parcelable"],
        &[
            method("getAction", "()Ljava/lang/String;", action),
            method("getData", "()Landroid/net/Uri;", data),
            method("getParcelableExtra", "(Ljava/lang/String;)Landroid/os/Parcelable;", parcelable_extra),
            method("getStringExtra", "(Ljava/lang/String;)Ljava/lang/String;", string_extra),
        ],
    ),
    class(
        "android/net/Uri",
        &["java/lang/Object", "android/os/Parcelable"],
        &[function("parse", "(Ljava/lang/String;)Landroid/net/Uri;", |call| Ok(uri(call.text(0))))],
    ),
    class(
        "android/content/ContentResolver",
        OBJECT,
        &[
            method(
                "openFileDescriptor",
                "(Landroid/net/Uri;Ljava/lang/String;)Landroid/os/ParcelFileDescriptor;",
                open_file_descriptor,
            ),
            method(
                "query",
                "(Landroid/net/Uri;[Ljava/lang/String;Ljava/lang/String;[Ljava/lang/String;Ljava/lang/String;)\
             Landroid/database/Cursor;",
                query,
            ),
        ],
    ),
    class(
        "android/os/ParcelFileDescriptor",
        &["java/lang/Object", "android/os/Parcelable"],
        &[method("detachFd", "()I", detach), method("close", "()V", close_file)],
    ),
    class(
        "android/database/Cursor",
        OBJECT,
        &[
            method("moveToFirst", "()Z", move_to_first),
            method("getString", "(I)Ljava/lang/String;", column),
            method("close", "()V", |_| Ok(Value::Void)),
        ],
    ),
    class(
        "android/content/ClipData",
        OBJECT,
        &[function(
            "newPlainText",
            "(Ljava/lang/CharSequence;Ljava/lang/CharSequence;)Landroid/content/ClipData;",
            |call| {
                let text = State::Text(call.text(1).unwrap_or_default());
                Ok(Value::Object(Some(Object::new(find("android/content/ClipData"), text))))
            },
        )],
    ),
    class(
        "android/content/ClipboardManager",
        OBJECT,
        &[method("setPrimaryClip", "(Landroid/content/ClipData;)V", |call| {
            with_world(|world| world.clipboard = call.text(0));
            Ok(Value::Void)
        })],
    ),
];

fn thing(class: &'static str) -> Answer {
    Ok(Value::Object(Some(Object::new(find(class), State::Nothing))))
}

fn uri(text: Option<String>) -> Value {
    Value::Object(text.map(|text| Object::new(find("android/net/Uri"), State::Text(text))))
}

fn system_service(call: &Call<'_>) -> Answer {
    match call.text(0).as_deref() {
        Some("clipboard") => thing("android/content/ClipboardManager"),
        Some("input_method") => thing("android/view/inputmethod/InputMethodManager"),
        other => {
            crate::report::complain(format!("the system service {other:?} is not played"));
            Ok(Value::NULL)
        }
    }
}

fn content_resolver(_call: &Call<'_>) -> Answer {
    thing("android/content/ContentResolver")
}

fn asset_manager(_call: &Call<'_>) -> Answer {
    thing("android/content/res/AssetManager")
}

fn application(_call: &Call<'_>) -> Answer {
    thing("android/app/Application")
}

fn window(_call: &Call<'_>) -> Answer {
    thing("android/view/Window")
}

fn intent(call: &Call<'_>) -> Answer {
    match &call.this.state {
        State::Activity { intent, .. } => Ok(Value::Object(Some(intent.clone()))),
        _ => Ok(Value::NULL),
    }
}

fn finish(call: &Call<'_>) -> Answer {
    on_main_thread("Activity.finish");
    if let State::Activity { finished, .. } = &call.this.state {
        finished.store(true, Ordering::SeqCst);
    }
    Ok(Value::NULL)
}

fn of_intent(
    call: &Call<'_>,
    take: impl Fn(&super::super::object::Intent) -> Option<String>,
) -> Option<String> {
    match &call.this.state {
        State::Intent(intent) => take(intent),
        _ => None,
    }
}

fn string(text: Option<String>) -> Value {
    text.map_or(Value::NULL, |text| Value::string(&text))
}

fn action(call: &Call<'_>) -> Answer {
    Ok(string(of_intent(call, |intent| intent.action.clone())))
}

fn data(call: &Call<'_>) -> Answer {
    Ok(uri(of_intent(call, |intent| intent.data.clone())))
}

fn parcelable_extra(call: &Call<'_>) -> Answer {
    let is_stream = call.text(0).is_some_and(|name| name == "android.intent.extra.STREAM");
    Ok(uri(of_intent(call, |intent| intent.stream.clone().filter(|_| is_stream))))
}

fn string_extra(call: &Call<'_>) -> Answer {
    let name = call.text(0).unwrap_or_default();
    Ok(string(of_intent(call, |intent| intent.extras.get(&name).cloned())))
}

fn content(call: &Call<'_>) -> Result<(std::path::PathBuf, String), Exception> {
    let uri = call.text(0).unwrap_or_default();
    match with_world(|world| world.content.get(&uri).cloned()) {
        Some(Content::File { path, name }) => Ok((path, name)),
        Some(Content::Forbidden) => Err(Exception {
            class: "java/lang/SecurityException",
            message: format!("Permission Denial: reading {uri} requires that you obtain access"),
        }),
        Some(Content::Missing) | None => Err(Exception {
            class: "java/io/FileNotFoundException",
            message: format!("No content provider: {uri}"),
        }),
    }
}

fn open_file_descriptor(call: &Call<'_>) -> Answer {
    let (path, _) = content(call)?;
    let file = File::open(&path).map_err(|e| Exception {
        class: "java/io/FileNotFoundException",
        message: format!("{}: {e}", path.display()),
    })?;
    let state = State::File(Mutex::new(Some(file.into())));
    Ok(Value::Object(Some(Object::new(find("android/os/ParcelFileDescriptor"), state))))
}

fn detach(call: &Call<'_>) -> Answer {
    let taken = match &call.this.state {
        State::File(file) => lock(file).take(),
        _ => None,
    };
    taken.map(|file| Value::Int(file.into_raw_fd())).ok_or_else(|| Exception {
        class: "java/lang/IllegalStateException",
        message: "Already closed".to_owned(),
    })
}

fn close_file(call: &Call<'_>) -> Answer {
    if let State::File(file) = &call.this.state {
        lock(file).take();
    }
    Ok(Value::Void)
}

/// A provider that does not know the file answers with no cursor at all.
fn query(call: &Call<'_>) -> Answer {
    match content(call) {
        Ok((_, name)) => {
            let state = State::Cursor { rows: vec![name], row: Mutex::new(None) };
            Ok(Value::Object(Some(Object::new(find("android/database/Cursor"), state))))
        }
        Err(exception) if exception.class == "java/lang/SecurityException" => Err(exception),
        Err(_) => Ok(Value::NULL),
    }
}

fn move_to_first(call: &Call<'_>) -> Answer {
    let State::Cursor { rows, row } = &call.this.state else { return Ok(Value::Boolean(false)) };
    *lock(row) = (!rows.is_empty()).then_some(0);
    Ok(Value::Boolean(!rows.is_empty()))
}

fn column(call: &Call<'_>) -> Answer {
    let State::Cursor { rows, row } = &call.this.state else { return Ok(Value::NULL) };
    let index = *lock(row);
    match (index, call.arguments) {
        (Some(index), [Value::Int(0)]) => Ok(Value::string(&rows[index])),
        _ => Err(Exception {
            class: "java/lang/IllegalArgumentException",
            message: "the cursor has one column and stands before its first row".to_owned(),
        }),
    }
}
