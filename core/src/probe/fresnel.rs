//! The shaders' Fresnel equations for boundaries of the caller's.

use super::dispatch;
use crate::{
    Gpu, Result,
    device::{mirror::gpu_struct, shader::Source},
    passes::{TRACE_GROUP, TRACE_ROW, wgsl},
};

gpu_struct! {
    /// A ray at the boundary of two dielectrics.
    pub struct ProbeBoundary {
        /// Of the angle to the normal, in [0, 1].
        cosine: f32,
        /// Index on the ray's side over that on the other.
        ratio: f32,
    }
}

gpu_struct! {
    /// Reflectance and refracted direction as the shader computes them.
    pub struct ProbeFresnel {
        /// Share that is reflected, of unpolarised light.
        reflectance: f32,
        /// Cosine on the other side, 0 where everything is reflected.
        transmitted: f32,
        /// 1 at total internal reflection, else 0.
        total: u32,
        /// Padding to the alignment of vec3.
        padding0: u32,
        /// Unit direction on the other side for the normal +z and a ray towards +x; zero where everything is reflected.
        refracted: [f32; 3],
        /// Padding to the alignment of vec3.
        padding1: u32,
    }
}

/// Runs the shaders' Fresnel equations for each boundary.
///
/// # Errors
/// A device that failed or cannot hold the boundaries.
pub fn fresnel(gpu: &Gpu, boundaries: &[ProbeBoundary]) -> Result<Vec<ProbeFresnel>> {
    Ok(dispatch(gpu, "probe_fresnel", &fresnel_sources(), boundaries, &[])?.0)
}

pub(crate) fn fresnel_sources() -> Vec<Source> {
    let text = format!("const TRACE_GROUP: u32 = {TRACE_GROUP}u;\nconst TRACE_ROW: u32 = {TRACE_ROW}u;\n");
    let constants = Source { file: "(constants)", text: text.into() };
    vec![constants, wgsl!("wgsl/shade/fresnel.wgsl"), wgsl!("wgsl/probe/probe_fresnel.wgsl")]
}
