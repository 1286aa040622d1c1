//! A graphics driver that runs programs over lists of numbers.

use std::io::Write;

use pollster::block_on;
use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{
    Adapter, Backends, BindGroupDescriptor, BindGroupEntry, Buffer, BufferDescriptor, BufferUsages,
    ComputePipelineDescriptor, Device, DeviceDescriptor, Instance, InstanceDescriptor, MapMode, PollType, Queue,
    RequestAdapterOptions, ShaderModuleDescriptor, ShaderSource,
};

use super::{bytes, values};

/// Pairs that are worked on together.
pub const GROUP: u32 = 64;

pub struct Driver {
    adapter: Adapter,
    device: Device,
    queue: Queue,
}

impl Driver {
    /// One in software, which is the same everywhere, before any other. None, said loudly, where there is no driver;
    /// with `NBRDF_REQUIRE_VULKAN=1` that is an error.
    pub fn found_or_skip() -> Option<Self> {
        let backends = Backends::VULKAN | Backends::METAL | Backends::DX12;
        let instance =
            Instance::new(InstanceDescriptor { backends, ..InstanceDescriptor::new_without_display_handle() });
        let find = |force_fallback_adapter| {
            block_on(instance.request_adapter(&RequestAdapterOptions { force_fallback_adapter, ..Default::default() }))
        };
        match find(true).or_else(|_| find(false)) {
            Ok(adapter) => {
                let (device, queue) = block_on(adapter.request_device(&DeviceDescriptor::default())).unwrap();
                Some(Self { adapter, device, queue })
            }
            Err(error) => {
                let missing =
                    format!("no Vulkan driver ({error}): install one (Debian: apt-get install mesa-vulkan-drivers)");
                assert!(std::env::var_os("NBRDF_REQUIRE_VULKAN").is_none_or(|v| v != "1"), "{missing}");
                // Straight to the stream: the test harness swallows `eprintln!` of tests that pass.
                let _ = writeln!(std::io::stderr(), "*** TEST SKIPPED: {missing} ***");
                None
            }
        }
    }

    pub fn name(&self) -> String {
        self.adapter.get_info().name
    }

    /// Runs `main` once for each six numbers of binding 0; gives the three for each that are in binding 1.
    pub fn run(&self, source: ShaderSource, given: &[f32]) -> Vec<f32> {
        let device = &self.device;
        let pairs = given.len() / 6;
        let module = device.create_shader_module(ShaderModuleDescriptor { label: None, source });
        let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        let contents = bytes(given);
        let input = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: &contents,
            usage: BufferUsages::STORAGE,
        });
        let output = self.buffer(pairs, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let read = self.buffer(pairs, BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let bind_group = device.create_bind_group(&BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[
                BindGroupEntry { binding: 0, resource: input.as_entire_binding() },
                BindGroupEntry { binding: 1, resource: output.as_entire_binding() },
            ],
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(u32::try_from(pairs).unwrap().div_ceil(GROUP), 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&output, 0, &read, 0, output.size());
        self.queue.submit([encoder.finish()]);
        read.map_async(MapMode::Read, .., |mapped| mapped.unwrap());
        device.poll(PollType::wait_indefinitely()).unwrap();
        values(&read.get_mapped_range(..).unwrap())
    }

    /// For three numbers of each pair.
    fn buffer(&self, pairs: usize, usage: BufferUsages) -> Buffer {
        let size = 12 * pairs as u64;
        self.device.create_buffer(&BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    }
}
