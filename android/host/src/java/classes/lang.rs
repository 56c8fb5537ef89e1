//! `java.lang`: what every JNI library leans on.

use std::sync::Mutex;

use super::super::class::{Call, Class, Method, class, find, function, method};
use super::super::machine;
use super::super::object::{Exception, Object, State, Value};
use super::{Answer, uncalled};
use crate::sync::lock;

pub const OBJECT_METHODS: &[Method] =
    &[method("<init>", "()V", |_| Ok(Value::Void)), method("toString", "()Ljava/lang/String;", to_string)];

const THROWABLE: &str = "java/lang/Throwable";
const OBJECT: &[&str] = &["java/lang/Object"];
const EXCEPTION: &[&str] = &["java/lang/Exception"];
const RUNTIME_EXCEPTION: &[&str] = &["java/lang/RuntimeException"];
const LINKAGE_ERROR: &[&str] = &["java/lang/LinkageError"];
const ERROR: &[&str] = &["java/lang/Error"];

pub static CLASSES: &[Class] = &[
    class(
        "java/lang/Class",
        OBJECT,
        &[
            method("getName", "()Ljava/lang/String;", class_name),
            function("forName", "(Ljava/lang/String;)Ljava/lang/Class;", load_class),
            function("forName", "(Ljava/lang/String;ZLjava/lang/ClassLoader;)Ljava/lang/Class;", load_class),
            method("getClassLoader", "()Ljava/lang/ClassLoader;", class_loader),
        ],
    ),
    class(
        "java/lang/ClassLoader",
        OBJECT,
        &[
            function("getSystemClassLoader", "()Ljava/lang/ClassLoader;", class_loader),
            method("loadClass", "(Ljava/lang/String;)Ljava/lang/Class;", load_class),
        ],
    ),
    class(
        "java/lang/Thread",
        OBJECT,
        &[
            function("currentThread", "()Ljava/lang/Thread;", |_| {
                Ok(Value::Object(machine::current_thread()))
            }),
            method("getName", "()Ljava/lang/String;", to_string),
            method("setName", "(Ljava/lang/String;)V", set_name),
            method("getId", "()J", |_| Ok(Value::Long(1))),
            method("getContextClassLoader", "()Ljava/lang/ClassLoader;", class_loader),
            method("setContextClassLoader", "(Ljava/lang/ClassLoader;)V", |_| Ok(Value::Void)),
        ],
    ),
    class(
        "java/lang/CharSequence",
        OBJECT,
        &[
            method("charAt", "(I)C", uncalled),
            method("length", "()I", uncalled),
            method("subSequence", "(II)Ljava/lang/CharSequence;", uncalled),
        ],
    ),
    class(
        "java/lang/String",
        &["java/lang/Object", "java/lang/CharSequence"],
        &[method("intern", "()Ljava/lang/String;", |call| Ok(Value::Object(Some(call.this.clone()))))],
    ),
    class("[Ljava/lang/Object;", OBJECT, &[]),
    class("[Ljava/lang/String;", &["[Ljava/lang/Object;"], &[]),
    class(
        THROWABLE,
        OBJECT,
        &[
            method("<init>", "()V", message),
            method("<init>", "(Ljava/lang/String;)V", message),
            method("<init>", "(Ljava/lang/String;Ljava/lang/Throwable;)V", message),
            method("<init>", "(Ljava/lang/Throwable;)V", message),
            method("<init>", "(I)V", message),
            method("getMessage", "()Ljava/lang/String;", to_string),
            method("getLocalizedMessage", "()Ljava/lang/String;", to_string),
            method("toString", "()Ljava/lang/String;", |call| {
                Ok(Value::string(&machine::describe(call.this)))
            }),
            method("getCause", "()Ljava/lang/Throwable;", |_| Ok(Value::NULL)),
            method("getException", "()Ljava/lang/Throwable;", |_| Ok(Value::NULL)),
            method("getStackTrace", "()[Ljava/lang/StackTraceElement;", empty_array),
            method("addSuppressed", "(Ljava/lang/Throwable;)V", |_| Ok(Value::Void)),
            method("getSuppressed", "()[Ljava/lang/Throwable;", empty_array),
        ],
    ),
    class(
        "java/lang/StackTraceElement",
        OBJECT,
        &[
            method("getClassName", "()Ljava/lang/String;", uncalled),
            method("getFileName", "()Ljava/lang/String;", uncalled),
            method("getLineNumber", "()I", uncalled),
            method("getMethodName", "()Ljava/lang/String;", uncalled),
            method("isNativeMethod", "()Z", uncalled),
        ],
    ),
    class("java/lang/Exception", &[THROWABLE], &[]),
    class("java/lang/RuntimeException", EXCEPTION, &[]),
    class("java/lang/SecurityException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/IllegalArgumentException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/IllegalStateException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/NullPointerException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/UnsupportedOperationException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/ArrayIndexOutOfBoundsException", RUNTIME_EXCEPTION, &[]),
    class("java/lang/ClassNotFoundException", EXCEPTION, &[]),
    class("java/io/IOException", EXCEPTION, &[]),
    class("java/io/FileNotFoundException", &["java/io/IOException"], &[]),
    class("java/lang/Error", &[THROWABLE], &[]),
    class("java/lang/OutOfMemoryError", ERROR, &[]),
    class("java/lang/LinkageError", ERROR, &[]),
    class("java/lang/ExceptionInInitializerError", LINKAGE_ERROR, &[]),
    class("java/lang/NoClassDefFoundError", LINKAGE_ERROR, &[]),
    class("java/lang/NoSuchMethodError", LINKAGE_ERROR, &[]),
    class("java/lang/NoSuchFieldError", LINKAGE_ERROR, &[]),
];

fn to_string(call: &Call<'_>) -> Answer {
    let text = call.this.text();
    Ok(Value::string(&text.unwrap_or_else(|| call.this.class.name.replace('/', "."))))
}

/// The message of a new throwable, which is what becomes its text.
fn message(call: &Call<'_>) -> Answer {
    Ok(Value::string(&call.text(0).unwrap_or_default()))
}

fn class_name(call: &Call<'_>) -> Answer {
    match &call.this.state {
        State::Class(class) => Ok(Value::string(&class.name.replace('/', "."))),
        _ => to_string(call),
    }
}

fn load_class(call: &Call<'_>) -> Answer {
    let name = call.text(0).unwrap_or_default();
    match Class::named(&name) {
        Some(class) => Ok(Value::Object(Some(class.object()))),
        None => {
            crate::report::complain(format!("the class {name} is not played"));
            Err(Exception { class: "java/lang/ClassNotFoundException", message: name })
        }
    }
}

fn class_loader(_call: &Call<'_>) -> Answer {
    Ok(Value::Object(Some(Object::new(find("java/lang/ClassLoader"), State::Nothing))))
}

fn set_name(call: &Call<'_>) -> Answer {
    if let (State::Name(name), Some(text)) = (&call.this.state, call.text(0)) {
        *lock(name) = text;
    }
    Ok(Value::Void)
}

fn empty_array(_call: &Call<'_>) -> Answer {
    let elements = State::Array(Mutex::default());
    Ok(Value::Object(Some(Object::new(find("[Ljava/lang/Object;"), elements))))
}
