//! `AConfiguration`: properties of the device and the display.

use std::ffi::{c_char, c_void};
use std::sync::Mutex;

use crate::bionic;
use crate::sync::lock;

/// Density of the display in dots an inch: 2.625 pixels a dp.
const DENSITY: i32 = 420;
const ORIENTATION_PORTRAIT: i32 = 1;
const ORIENTATION_LANDSCAPE: i32 = 2;

/// The properties that change while the app runs.
#[derive(Clone, Copy)]
pub struct AConfiguration {
    /// Width and height of the display in pixels.
    size: [u32; 2],
}

static CURRENT: Mutex<AConfiguration> = Mutex::new(AConfiguration { size: [320, 180] });

/// Sets the size of the display in pixels.
pub fn set_size(size: [u32; 2]) {
    lock(&CURRENT).size = size;
}

#[unsafe(no_mangle)]
extern "C" fn AConfiguration_new() -> *mut AConfiguration {
    Box::into_raw(Box::new(AConfiguration { size: [0, 0] }))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_delete(configuration: *mut AConfiguration) {
    drop(Box::from_raw(configuration));
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_copy(to: *mut AConfiguration, from: *mut AConfiguration) {
    *to = *from;
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_fromAssetManager(
    configuration: *mut AConfiguration,
    _manager: *mut c_void,
) {
    *configuration = *lock(&CURRENT);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_diff(one: *mut AConfiguration, other: *mut AConfiguration) -> i32 {
    const ORIENTATION: i32 = 0x80;
    const SCREEN_SIZE: i32 = 0x200;
    let changed = |differs: bool, bit| if differs { bit } else { 0 };
    changed(AConfiguration_getOrientation(one) != AConfiguration_getOrientation(other), ORIENTATION)
        | changed((*one).size != (*other).size, SCREEN_SIZE)
}

#[unsafe(no_mangle)]
extern "C" fn AConfiguration_match(_base: *mut AConfiguration, _requested: *mut AConfiguration) -> i32 {
    1
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getLanguage(_configuration: *mut AConfiguration, code: *mut c_char) {
    code.cast::<[u8; 2]>().write(*b"en");
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getCountry(_configuration: *mut AConfiguration, code: *mut c_char) {
    code.cast::<[u8; 2]>().write(*b"GB");
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getOrientation(configuration: *mut AConfiguration) -> i32 {
    let [width, height] = (*configuration).size;
    if width > height { ORIENTATION_LANDSCAPE } else { ORIENTATION_PORTRAIT }
}

/// Converts pixels to density-independent pixels, of which an inch has 160.
fn dp(pixels: u32) -> i32 {
    pixels as i32 * 160 / DENSITY
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getScreenWidthDp(configuration: *mut AConfiguration) -> i32 {
    dp((*configuration).size[0])
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getScreenHeightDp(configuration: *mut AConfiguration) -> i32 {
    dp((*configuration).size[1])
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AConfiguration_getSmallestScreenWidthDp(configuration: *mut AConfiguration) -> i32 {
    let [width, height] = (*configuration).size;
    dp(width.min(height))
}

#[unsafe(no_mangle)]
extern "C" fn AConfiguration_getSdkVersion(_configuration: *mut AConfiguration) -> i32 {
    bionic::api_level()
}

macro_rules! constants {
    ($($name:ident = $value:expr;)*) => { $(
        #[unsafe(no_mangle)]
        extern "C" fn $name(_configuration: *mut AConfiguration) -> i32 {
            $value
        }
    )* };
}
constants! {
    AConfiguration_getDensity = DENSITY;
    AConfiguration_getKeyboard = 1; // none
    AConfiguration_getKeysHidden = 1; // no
    AConfiguration_getLayoutDirection = 1; // left to right
    AConfiguration_getMcc = 0; // no country of a mobile network
    AConfiguration_getMnc = 0; // no mobile network
    AConfiguration_getNavHidden = 1; // no
    AConfiguration_getNavigation = 1; // none
    AConfiguration_getScreenLong = 2; // yes
    AConfiguration_getScreenSize = 2; // normal
    AConfiguration_getTouchscreen = 3; // finger
    AConfiguration_getUiModeNight = 1; // no
    AConfiguration_getUiModeType = 1; // normal
}
