//! The function table of `JNIEnv`. What is not played here fails the run with its place in the table.

use std::ffi::{CStr, c_char, c_void};
use std::sync::{Arc, Mutex};

use super::call::{Argument, Of, call, construct, to_number, to_reference};
use super::class::{Class, Constant, Method, find};
use super::machine::{self, enter};
use super::object::{Exception, Object, State};
use super::reference::{self, Kind};
use super::strings;
use crate::report;
use crate::sync::lock;

type Environment_ = *mut c_void;
type Handle = *mut c_void;

/// 256 places: the table of JNI 21 has 235.
pub type Environment = Vec<usize>;

/// A function that is not played, at place `16 * HIGH + LOW`.
extern "C" fn unplayed<const HIGH: usize, const LOW: usize>() -> usize {
    report::complain(format!("function {} of the JNI table is not played", 16 * HIGH + LOW));
    0
}

macro_rules! row {
    ($high:literal) => { row!($high: 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15) };
    ($high:literal: $($low:literal)*) => { [$(unplayed::<$high, $low> as *const () as usize),*] };
}

macro_rules! rows {
    ($($high:literal)*) => { [$(row!($high)),*] };
}

macro_rules! places {
    ($table:ident: $($place:literal = $function:expr;)*) => { $($table[$place] = $function as *const () as usize;)* };
}

/// The table (JNI specification, "Interface Function Table").
pub fn functions() -> Environment {
    let mut table = rows!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15).concat();
    places! { table:
        4 = get_version; 6 = find_class; 10 = get_superclass; 11 = is_assignable_from;
        13 = throw; 14 = throw_new; 15 = exception_occurred; 16 = exception_describe; 17 = exception_clear;
        18 = fatal_error; 19 = push_local_frame; 20 = pop_local_frame; 21 = new_global_ref; 22 = delete_global_ref;
        23 = delete_local_ref; 24 = is_same_object; 25 = new_local_ref; 26 = ensure_local_capacity;
        30 = new_object; 31 = get_object_class; 32 = is_instance_of; 33 = get_method_id;
        36 = call_object; 39 = call_boolean; 42 = call_byte; 45 = call_char; 48 = call_short; 51 = call_int;
        54 = call_long; 63 = call_void;
        113 = get_static_method_id;
        116 = call_static_object; 119 = call_static_boolean; 122 = call_static_byte; 125 = call_static_char;
        128 = call_static_short; 131 = call_static_int; 134 = call_static_long; 143 = call_static_void;
        144 = get_static_field_id; 145 = get_static_object_field;
        164 = get_string_length; 167 = new_string_utf; 168 = get_string_utf_length; 169 = get_string_utf_chars;
        170 = release_string_utf_chars; 171 = get_array_length; 172 = new_object_array;
        173 = get_object_array_element; 174 = set_object_array_element;
        217 = monitor; 218 = monitor; 219 = get_java_vm; 226 = new_weak_global_ref; 227 = delete_weak_global_ref;
        228 = exception_check; 232 = get_object_ref_type;
    }
    table
}

fn local(object: Option<Arc<Object>>) -> Handle {
    reference::make(Kind::Local, object)
}

fn throw_now(class: &'static str, message: String) {
    machine::throw(&Exception { class, message });
}

/// The class that a reference is of; anything else is complained of.
fn class_of(handle: Handle, function: &str) -> Option<&'static Class> {
    match reference::resolve(handle).map(|object| match object.state {
        State::Class(class) => Some(class),
        _ => None,
    }) {
        Some(Some(class)) => Some(class),
        _ => {
            report::complain(format!("{function} without a class"));
            None
        }
    }
}

extern "C" fn get_version(_environment: Environment_) -> i32 {
    0x0001_0006
}

unsafe extern "C" fn find_class(_environment: Environment_, name: *const c_char) -> Handle {
    enter("FindClass", false);
    let name = CStr::from_ptr(name).to_string_lossy();
    match Class::named(&name).filter(|_| !name.contains('.')) {
        Some(class) => local(Some(class.object())),
        None => {
            report::complain(format!("the class {name} is not played"));
            throw_now("java/lang/NoClassDefFoundError", name.into_owned());
            std::ptr::null_mut()
        }
    }
}

extern "C" fn get_superclass(_environment: Environment_, class: Handle) -> Handle {
    enter("GetSuperclass", false);
    local(class_of(class, "GetSuperclass").and_then(Class::superclass).map(Class::object))
}

extern "C" fn is_assignable_from(_environment: Environment_, from: Handle, to: Handle) -> u8 {
    enter("IsAssignableFrom", false);
    let classes = (class_of(from, "IsAssignableFrom"), class_of(to, "IsAssignableFrom"));
    u8::from(matches!(classes, (Some(from), Some(to)) if from.is_a(to)))
}

extern "C" fn throw(_environment: Environment_, exception: Handle) -> i32 {
    enter("Throw", false);
    reference::resolve(exception).map_or(-1, |exception| {
        machine::throw_object(exception);
        0
    })
}

unsafe extern "C" fn throw_new(_environment: Environment_, class: Handle, message: *const c_char) -> i32 {
    enter("ThrowNew", false);
    let Some(class) = class_of(class, "ThrowNew") else { return -1 };
    let message = if message.is_null() { None } else { strings::decode(message) };
    throw_now(class.name, message.unwrap_or_default());
    0
}

extern "C" fn exception_occurred(_environment: Environment_) -> Handle {
    enter("ExceptionOccurred", true);
    local(machine::pending())
}

extern "C" fn exception_describe(_environment: Environment_) {
    enter("ExceptionDescribe", true);
    if let Some(exception) = machine::take_pending() {
        report::say_log(&format!("W/System.err: {}", machine::describe(&exception)));
    }
}

extern "C" fn exception_clear(_environment: Environment_) {
    enter("ExceptionClear", true);
    machine::take_pending();
}

extern "C" fn exception_check(_environment: Environment_) -> u8 {
    enter("ExceptionCheck", true);
    u8::from(machine::pending().is_some())
}

unsafe extern "C" fn fatal_error(_environment: Environment_, message: *const c_char) {
    report::complain(format!("FatalError: {}", CStr::from_ptr(message).to_string_lossy()));
}

extern "C" fn push_local_frame(_environment: Environment_, _capacity: i32) -> i32 {
    enter("PushLocalFrame", true);
    reference::push_frame();
    0
}

extern "C" fn pop_local_frame(_environment: Environment_, result: Handle) -> Handle {
    enter("PopLocalFrame", true);
    let result = reference::resolve(result);
    reference::pop_frame();
    local(result)
}

extern "C" fn ensure_local_capacity(_environment: Environment_, _capacity: i32) -> i32 {
    enter("EnsureLocalCapacity", false);
    0
}

extern "C" fn new_global_ref(_environment: Environment_, object: Handle) -> Handle {
    enter("NewGlobalRef", true);
    reference::make(Kind::Global, reference::resolve(object))
}

extern "C" fn delete_global_ref(_environment: Environment_, object: Handle) {
    enter("DeleteGlobalRef", true);
    reference::delete(Kind::Global, object);
}

extern "C" fn new_weak_global_ref(_environment: Environment_, object: Handle) -> Handle {
    enter("NewWeakGlobalRef", true);
    reference::make(Kind::Weak, reference::resolve(object))
}

extern "C" fn delete_weak_global_ref(_environment: Environment_, object: Handle) {
    enter("DeleteWeakGlobalRef", true);
    reference::delete(Kind::Weak, object);
}

extern "C" fn new_local_ref(_environment: Environment_, object: Handle) -> Handle {
    enter("NewLocalRef", true);
    local(reference::resolve(object))
}

extern "C" fn delete_local_ref(_environment: Environment_, object: Handle) {
    enter("DeleteLocalRef", true);
    reference::delete(Kind::Local, object);
}

extern "C" fn is_same_object(_environment: Environment_, one: Handle, other: Handle) -> u8 {
    enter("IsSameObject", true);
    u8::from(match (reference::resolve(one), reference::resolve(other)) {
        (None, None) => true,
        (Some(one), Some(other)) => match (&one.state, &other.state) {
            (State::Class(one), State::Class(other)) => std::ptr::eq(*one, *other),
            _ => Arc::ptr_eq(&one, &other),
        },
        _ => false,
    })
}

extern "C" fn get_object_ref_type(_environment: Environment_, object: Handle) -> i32 {
    reference::kind(object).map_or(0, |kind| kind as i32)
}

extern "C" fn get_object_class(_environment: Environment_, object: Handle) -> Handle {
    enter("GetObjectClass", false);
    local(reference::resolve(object).map(|object| object.class.object()))
}

extern "C" fn is_instance_of(_environment: Environment_, object: Handle, class: Handle) -> u8 {
    enter("IsInstanceOf", true);
    let Some(class) = class_of(class, "IsInstanceOf") else { return 0 };
    // Null is of every class.
    u8::from(reference::resolve(object).is_none_or(|object| object.class.is_a(class)))
}

unsafe fn method_id(
    class: Handle,
    name: *const c_char,
    signature: *const c_char,
    is_static: bool,
) -> *const Method {
    enter("GetMethodID", false);
    let [name, signature] = [name, signature].map(|text| CStr::from_ptr(text).to_string_lossy());
    let Some(class) = class_of(class, "GetMethodID") else { return std::ptr::null() };
    if let Some(method) = class.method(&name, &signature, is_static) {
        return method;
    }
    report::complain(format!("the class {} has no method {name}{signature}", class.name));
    throw_now("java/lang/NoSuchMethodError", format!("{}.{name}{signature}", class.name));
    std::ptr::null()
}

unsafe extern "C" fn get_method_id(
    _environment: Environment_,
    class: Handle,
    name: *const c_char,
    signature: *const c_char,
) -> *const Method {
    method_id(class, name, signature, false)
}

unsafe extern "C" fn get_static_method_id(
    _environment: Environment_,
    class: Handle,
    name: *const c_char,
    signature: *const c_char,
) -> *const Method {
    method_id(class, name, signature, true)
}

unsafe extern "C" fn get_static_field_id(
    _environment: Environment_,
    class: Handle,
    name: *const c_char,
    signature: *const c_char,
) -> *const Constant {
    enter("GetStaticFieldID", false);
    let [name, signature] = [name, signature].map(|text| CStr::from_ptr(text).to_string_lossy());
    let Some(class) = class_of(class, "GetStaticFieldID") else { return std::ptr::null() };
    if let Some(constant) = class.constant(&name).filter(|_| signature == "Ljava/lang/String;") {
        return constant;
    }
    report::complain(format!("the class {} has no constant {name} of type {signature}", class.name));
    throw_now("java/lang/NoSuchFieldError", name.into_owned());
    std::ptr::null()
}

unsafe extern "C" fn get_static_object_field(
    _environment: Environment_,
    _class: Handle,
    field: *const Constant,
) -> Handle {
    enter("GetStaticObjectField", false);
    local(field.as_ref().map(|constant| Object::string(constant.value)))
}

unsafe extern "C" fn new_object(
    _environment: Environment_,
    class: Handle,
    method: *const Method,
    arguments: *const Argument,
) -> Handle {
    construct(class, method, arguments)
}

macro_rules! calls {
    ($($of_object:ident $of_class:ident -> $type:ty: $convert:expr;)*) => { $(
        unsafe extern "C" fn $of_object(
            _environment: Environment_, this: Handle, method: *const Method, arguments: *const Argument,
        ) -> $type {
            $convert(call(Of::Object, this, method, arguments))
        }
        unsafe extern "C" fn $of_class(
            _environment: Environment_, this: Handle, method: *const Method, arguments: *const Argument,
        ) -> $type {
            $convert(call(Of::Class, this, method, arguments))
        }
    )* };
}
calls! {
    call_object call_static_object -> Handle: to_reference;
    call_boolean call_static_boolean -> u8: |value| to_number(&value) as u8;
    call_byte call_static_byte -> i8: |value| to_number(&value) as i8;
    call_char call_static_char -> u16: |value| to_number(&value) as u16;
    call_short call_static_short -> i16: |value| to_number(&value) as i16;
    call_int call_static_int -> i32: |value| to_number(&value) as i32;
    call_long call_static_long -> i64: |value| to_number(&value);
    call_void call_static_void -> (): drop;
}

fn text(string: Handle, function: &str) -> String {
    let text = reference::resolve(string).and_then(|object| object.text());
    text.unwrap_or_else(|| {
        report::complain(format!("{function} without a string"));
        String::new()
    })
}

unsafe extern "C" fn new_string_utf(_environment: Environment_, bytes: *const c_char) -> Handle {
    enter("NewStringUTF", false);
    match strings::decode(bytes) {
        Some(text) => local(Some(Object::string(&text))),
        None => {
            report::complain("NewStringUTF: not modified UTF-8".to_owned());
            std::ptr::null_mut()
        }
    }
}

extern "C" fn get_string_length(_environment: Environment_, string: Handle) -> i32 {
    text(string, "GetStringLength").encode_utf16().count() as i32
}

extern "C" fn get_string_utf_length(_environment: Environment_, string: Handle) -> i32 {
    strings::encode(&text(string, "GetStringUTFLength")).as_bytes().len() as i32
}

unsafe extern "C" fn get_string_utf_chars(
    _environment: Environment_,
    string: Handle,
    is_copy: *mut u8,
) -> *const c_char {
    enter("GetStringUTFChars", false);
    if let Some(is_copy) = is_copy.as_mut() {
        *is_copy = 1;
    }
    strings::encode(&text(string, "GetStringUTFChars")).into_raw()
}

unsafe extern "C" fn release_string_utf_chars(
    _environment: Environment_,
    _string: Handle,
    bytes: *mut c_char,
) {
    drop(std::ffi::CString::from_raw(bytes));
}

/// Acts on the elements of an array.
fn with_array<T: Default>(
    array: Handle,
    function: &str,
    act: impl FnOnce(&mut Vec<Option<Arc<Object>>>) -> T,
) -> T {
    if let Some(object) = reference::resolve(array)
        && let State::Array(elements) = &object.state
    {
        return act(&mut lock(elements));
    }
    report::complain(format!("{function} without an array of objects"));
    T::default()
}

extern "C" fn get_array_length(_environment: Environment_, array: Handle) -> i32 {
    with_array(array, "GetArrayLength", |elements| elements.len() as i32)
}

extern "C" fn new_object_array(
    _environment: Environment_,
    length: i32,
    _class: Handle,
    first: Handle,
) -> Handle {
    enter("NewObjectArray", false);
    let elements = vec![reference::resolve(first); usize::try_from(length).unwrap_or(0)];
    local(Some(Object::new(find("[Ljava/lang/Object;"), State::Array(Mutex::new(elements)))))
}

fn out_of_bounds(index: i32) {
    throw_now("java/lang/ArrayIndexOutOfBoundsException", index.to_string());
}

extern "C" fn get_object_array_element(_environment: Environment_, array: Handle, index: i32) -> Handle {
    enter("GetObjectArrayElement", false);
    let element =
        with_array(array, "GetObjectArrayElement", |elements| elements.get(index as usize).cloned());
    local(element.unwrap_or_else(|| {
        out_of_bounds(index);
        None
    }))
}

extern "C" fn set_object_array_element(_environment: Environment_, array: Handle, index: i32, value: Handle) {
    enter("SetObjectArrayElement", false);
    let value = reference::resolve(value);
    let is_set = with_array(array, "SetObjectArrayElement", |elements| {
        elements.get_mut(index as usize).map(|element| *element = value).is_some()
    });
    if !is_set {
        out_of_bounds(index);
    }
}

/// No two threads of the app compete for an object of these classes.
extern "C" fn monitor(_environment: Environment_, _object: Handle) -> i32 {
    0
}

unsafe extern "C" fn get_java_vm(_environment: Environment_, out: *mut *mut c_void) -> i32 {
    *out = machine::vm();
    0
}
