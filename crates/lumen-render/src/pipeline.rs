//! How a pipeline over the scene is made: what pipelines differ in, and the rest that they share.

use super::ViewTarget;
use super::scene::SceneLayout;

/// Adds what is drawn to what is there.
pub(super) const ADD: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Add,
};

/// What a pipeline draws into.
#[derive(Clone, Copy)]
pub(super) enum Destination {
    /// A [`ViewTarget`].
    View,
    /// One texture of this format, a sample a pixel, without depth.
    Texture(wgpu::TextureFormat),
    /// Depth alone, a sample a pixel.
    Depth,
}

/// What differs between pipelines.
#[derive(Clone, Copy)]
pub(super) struct PipelineParts<'a> {
    pub(super) label: &'static str,
    pub(super) module: &'a wgpu::ShaderModule,
    pub(super) vertex: &'static str,
    pub(super) fragment: &'static str,
    /// Formats of the vertex buffers, one attribute each, locations in their order.
    pub(super) attributes: &'a [wgpu::VertexFormat],
    pub(super) topology: wgpu::PrimitiveTopology,
    pub(super) depth_compare: wgpu::CompareFunction,
    pub(super) depth_write: bool,
    pub(super) depth_bias: wgpu::DepthBiasState,
    pub(super) blend: Option<wgpu::BlendState>,
    pub(super) write_mask: wgpu::ColorWrites,
    /// The side that is left out.
    pub(super) cull: Option<wgpu::Face>,
    /// What is drawn into.
    pub(super) into: Destination,
    /// What is bound beside the scene and the paint, as group 2.
    pub(super) group: Option<&'a wgpu::BindGroupLayout>,
}

impl<'a> PipelineParts<'a> {
    /// Opaque triangles with depth.
    pub(super) fn new(label: &'static str, module: &'a wgpu::ShaderModule) -> Self {
        Self {
            label,
            module,
            vertex: "vertex",
            fragment: "fragment",
            attributes: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            depth_compare: wgpu::CompareFunction::GreaterEqual,
            depth_write: true,
            depth_bias: wgpu::DepthBiasState::default(),
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
            cull: None,
            into: Destination::View,
            group: None,
        }
    }
}

impl SceneLayout {
    /// A pipeline over these layouts, into a [`ViewTarget`]; its module is made by `scene_shader!`.
    pub(super) fn pipeline(&self, parts: &PipelineParts<'_>) -> wgpu::RenderPipeline {
        let attributes: Vec<[wgpu::VertexAttribute; 1]> = (0..)
            .zip(parts.attributes)
            .map(|(shader_location, &format)| [wgpu::VertexAttribute { format, offset: 0, shader_location }])
            .collect();
        let buffers: Vec<_> = attributes
            .iter()
            .map(|attributes| {
                Some(wgpu::VertexBufferLayout {
                    array_stride: attributes[0].format.size(),
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes,
                })
            })
            .collect();
        let (colour, has_depth, count) = match parts.into {
            Destination::View => (Some(ViewTarget::FORMAT), true, ViewTarget::SAMPLES),
            Destination::Texture(format) => (Some(format), false, 1),
            Destination::Depth => (None, true, 1),
        };
        let colour = colour
            .map(|format| Some(wgpu::ColorTargetState { format, blend: parts.blend, write_mask: parts.write_mask }));
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(parts.label),
            layout: Some(&self.pipeline_layout(parts.group)),
            vertex: wgpu::VertexState {
                module: parts.module,
                entry_point: Some(parts.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState { topology: parts.topology, cull_mode: parts.cull, ..Default::default() },
            depth_stencil: has_depth.then(|| wgpu::DepthStencilState {
                format: ViewTarget::DEPTH_FORMAT,
                depth_write_enabled: Some(parts.depth_write),
                depth_compare: Some(parts.depth_compare),
                stencil: wgpu::StencilState::default(),
                bias: parts.depth_bias,
            }),
            multisample: wgpu::MultisampleState { count, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: parts.module,
                entry_point: Some(parts.fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: colour.as_slice(),
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// Draws `pipeline`, whose vertices are those of `vertex_everywhere`, over the whole target.
pub(super) fn cover(pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
    pass.set_pipeline(pipeline);
    pass.draw(0..3, 0..1);
}

/// The source of a shader of this folder with `scene.wgsl` in front.
macro_rules! scene_shader {
    ($device:expr, $file:literal) => {
        $device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some($file),
            source: wgpu::ShaderSource::Wgsl(concat!(include_str!("scene.wgsl"), include_str!($file)).into()),
        })
    };
}
pub(super) use scene_shader;
