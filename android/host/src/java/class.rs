//! Classes: names, parents, methods by name and signature, and string constants.

use super::classes;
use super::object::{Exception, Object, State, Value};
use std::sync::Arc;

/// What a method is called with.
pub struct Call<'a> {
    /// The object, or the class of a static method.
    pub this: &'a Arc<Object>,
    /// The arguments in their order.
    pub arguments: &'a [Value],
}

impl Call<'_> {
    /// The text of an argument that is a string or a URI; null gives nothing.
    pub fn text(&self, index: usize) -> Option<String> {
        match self.arguments.get(index) {
            Some(Value::Object(Some(object))) => object.text(),
            _ => None,
        }
    }
}

/// What a method does.
pub type Body = fn(&Call<'_>) -> Result<Value, Exception>;

/// A method; its address is its identifier.
pub struct Method {
    /// `<init>` for constructors.
    pub name: &'static str,
    /// As in class files: `(Ljava/lang/String;)V`.
    pub signature: &'static str,
    /// Whether it belongs to the class and not to its objects.
    pub is_static: bool,
    /// What it does.
    pub body: Body,
}

/// A method of objects.
pub const fn method(name: &'static str, signature: &'static str, body: Body) -> Method {
    Method { name, signature, is_static: false, body }
}

/// A method of the class.
pub const fn function(name: &'static str, signature: &'static str, body: Body) -> Method {
    Method { name, signature, is_static: true, body }
}

/// A constant string of a class; its address is its identifier.
pub struct Constant {
    /// Its name.
    pub name: &'static str,
    /// Its value.
    pub value: &'static str,
}

/// A class or an interface.
pub struct Class {
    /// With slashes: `java/lang/String`.
    pub name: &'static str,
    /// Names of the class it extends and of the interfaces that it implements.
    pub parents: &'static [&'static str],
    /// Its own methods.
    pub methods: &'static [Method],
    /// Its own constants.
    pub constants: &'static [Constant],
}

/// A class without constants.
pub const fn class(
    name: &'static str,
    parents: &'static [&'static str],
    methods: &'static [Method],
) -> Class {
    Class { name, parents, methods, constants: &[] }
}

impl Class {
    /// The class of a name with slashes or dots.
    pub fn named(name: &str) -> Option<&'static Self> {
        let is_it =
            |class: &&Self| class.name.chars().eq(name.chars().map(|c| if c == '.' { '/' } else { c }));
        classes::all().find(is_it)
    }

    fn parents(&self) -> impl Iterator<Item = &'static Self> {
        self.parents.iter().copied().filter_map(Self::named)
    }

    /// Whether an object of this class is one of `other`.
    pub fn is_a(&self, other: &Self) -> bool {
        std::ptr::eq(self, other) || self.parents().any(|parent| parent.is_a(other))
    }

    /// The first parent, which is the class that it extends.
    pub fn superclass(&self) -> Option<&'static Self> {
        self.parents().next()
    }

    /// A method of this class or of what it extends; constructors of throwables stand with `Throwable`.
    pub fn method(&'static self, name: &str, signature: &str, is_static: bool) -> Option<&'static Method> {
        let is_it = |method: &&Method| {
            method.name == name && method.signature == signature && method.is_static == is_static
        };
        let own = self.methods.iter().find(is_it);
        own.or_else(|| self.parents().find_map(|parent| parent.method(name, signature, is_static)))
    }

    /// Whether `method` is one of this class or of what it extends.
    pub fn has(&self, method: &Method) -> bool {
        self.methods.iter().any(|own| std::ptr::eq(own, method))
            || self.parents().any(|parent| parent.has(method))
    }

    /// A constant of this class or of what it extends.
    pub fn constant(&'static self, name: &str) -> Option<&'static Constant> {
        let own = self.constants.iter().find(|constant| constant.name == name);
        own.or_else(|| self.parents().find_map(|parent| parent.constant(name)))
    }

    /// The class as an object.
    pub fn object(&'static self) -> Arc<Object> {
        Object::new(find("java/lang/Class"), State::Class(self))
    }
}

/// A class that the host itself names.
pub fn find(name: &'static str) -> &'static Class {
    Class::named(name).unwrap_or(&classes::OBJECT)
}
