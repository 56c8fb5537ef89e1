//! `android.view`: the window's decoration, insets and cutout, and the keyboard.

use super::super::class::{Call, Class, class, find, function, method};
use super::super::machine;
use super::super::object::{Object, State, Value};
use super::super::world::with_world;
use super::{Answer, uncalled};
use crate::report;

const OBJECT: &[&str] = &["java/lang/Object"];

pub static CLASSES: &[Class] = &[
    class(
        "android/view/Window",
        OBJECT,
        &[method("getDecorView", "()Landroid/view/View;", |_| {
            Ok(Value::Object(Some(Object::new(find("android/view/View"), State::Nothing))))
        })],
    ),
    class(
        "android/view/View",
        OBJECT,
        &[
            method("getWindowToken", "()Landroid/os/IBinder;", uncalled),
            method("setSystemUiVisibility", "(I)V", set_system_ui),
            method("getRootWindowInsets", "()Landroid/view/WindowInsets;", root_window_insets),
        ],
    ),
    class(
        "android/view/WindowInsets",
        OBJECT,
        &[method("getDisplayCutout", "()Landroid/view/DisplayCutout;", display_cutout)],
    ),
    class(
        "android/view/DisplayCutout",
        OBJECT,
        &[
            method("getSafeInsetLeft", "()I", |call| inset(call, 0)),
            method("getSafeInsetTop", "()I", |call| inset(call, 1)),
            method("getSafeInsetRight", "()I", |call| inset(call, 2)),
            method("getSafeInsetBottom", "()I", |call| inset(call, 3)),
        ],
    ),
    class(
        "android/view/inputmethod/InputMethodManager",
        OBJECT,
        &[
            method("showSoftInput", "(Landroid/view/View;I)Z", uncalled),
            method("hideSoftInputFromWindow", "(Landroid/os/IBinder;I)Z", uncalled),
        ],
    ),
    class(
        "android/view/InputDevice",
        OBJECT,
        &[
            function("getDevice", "(I)Landroid/view/InputDevice;", uncalled),
            method("getKeyCharacterMap", "()Landroid/view/KeyCharacterMap;", uncalled),
        ],
    ),
    class(
        "android/view/KeyCharacterMap",
        OBJECT,
        &[
            method("get", "(II)I", uncalled),
            function("getDeadChar", "(II)I", uncalled),
            method("getKeyboardType", "()I", uncalled),
        ],
    ),
];

/// Views may be touched by the thread that made them only.
pub(super) fn on_main_thread(what: &str) {
    if !machine::is_main_thread() {
        report::complain(format!("{what} on another thread than Java's main thread"));
    }
}

fn set_system_ui(call: &Call<'_>) -> Answer {
    on_main_thread("View.setSystemUiVisibility");
    if let [Value::Int(flags)] = call.arguments {
        with_world(|world| world.system_ui = *flags);
    }
    Ok(Value::Void)
}

fn root_window_insets(_call: &Call<'_>) -> Answer {
    on_main_thread("View.getRootWindowInsets");
    Ok(Value::Object(Some(Object::new(find("android/view/WindowInsets"), State::Nothing))))
}

fn display_cutout(_call: &Call<'_>) -> Answer {
    let insets = with_world(|world| world.cutout);
    Ok(Value::Object(
        insets.map(|insets| Object::new(find("android/view/DisplayCutout"), State::Insets(insets))),
    ))
}

fn inset(call: &Call<'_>, side: usize) -> Answer {
    match call.this.state {
        State::Insets(insets) => Ok(Value::Int(insets[side])),
        _ => Ok(Value::Int(0)),
    }
}
