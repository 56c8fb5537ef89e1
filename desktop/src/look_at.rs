//! `--eye` and related options: a camera defined on the command line.

use std::str::FromStr;

use clap::Args;
use glimpse::glam::DVec3;
use glimpse::{Camera, Lens, LookAt};

use super::SCENE;

/// A camera of one's own instead of one of the scene.
#[derive(Clone, Debug, Default, PartialEq, Args)]
#[command(next_help_heading = SCENE)]
pub struct LookAtOptions {
    /// A camera at this point of the scene
    #[arg(long, hide_short_help = true, value_name = "X,Y,Z", value_parser = Point::from_str,
        allow_negative_numbers = true, requires = "target", conflicts_with = "camera")]
    pub eye: Option<Point>,
    /// The point at the centre of that camera's picture
    #[arg(long, hide_short_help = true, value_name = "X,Y,Z", value_parser = Point::from_str,
        allow_negative_numbers = true, requires = "eye")]
    pub target: Option<Point>,
    /// The upward direction of that camera [default: 0,1,0]
    #[arg(long, hide_short_help = true, value_name = "X,Y,Z", value_parser = Point::from_str,
        allow_negative_numbers = true, requires = "eye")]
    pub up: Option<Point>,
    /// Vertical field of view of that camera in degrees [default: 45]
    #[arg(
        long,
        hide_short_help = true,
        value_name = "DEGREES",
        allow_negative_numbers = true,
        requires = "eye"
    )]
    pub fov: Option<f32>,
    /// Use an orthographic camera that shows this height of the scene
    #[arg(
        long,
        hide_short_help = true,
        value_name = "HEIGHT",
        allow_negative_numbers = true,
        requires = "eye",
        conflicts_with = "fov"
    )]
    pub ortho: Option<f32>,
}

impl LookAtOptions {
    /// Makes the camera, if `--eye` was given, in a scene whose origin is this point of its file.
    pub fn camera(&self, origin: DVec3) -> glimpse::Result<Option<Camera>> {
        let (Some(Point(eye)), Some(Point(target))) = (self.eye, self.target) else { return Ok(None) };
        let lens = match self.ortho {
            Some(height) => Lens::Orthographic { height },
            None => Lens::Perspective { vertical_fov_degrees: self.fov.unwrap_or(45.0) },
        };
        let up = self.up.map_or(DVec3::Y, |Point(up)| up);
        let [eye, target] = [eye, target].map(|point| (point - origin).as_vec3());
        LookAt { eye, target, up: up.as_vec3(), lens }.camera().map(Some)
    }
}

/// A point or direction in world space, typed as `X,Y,Z`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point(pub DVec3);

impl FromStr for Point {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) if [x, y, z].iter().all(|c| (*c as f32).is_finite()) => {
                Ok(Self(DVec3::new(x, y, z)))
            }
            _ => Err("expected three numbers X,Y,Z".to_owned()),
        }
    }
}
