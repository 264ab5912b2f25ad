//! A frame's dispatches on their way to the device, a few frames ahead of it.

use super::commands::{Command, KernelUse};
use super::timing::Timer;
use super::{GpuBackend, readback};
use crate::backend::BackendError;
use crate::layout::{Counts, Frame, SpreadCounts};
use crate::plan::{FrameInputs, Stage};

/// Frames that may be under way on the device at once.
const FRAMES_IN_FLIGHT: usize = 3;

impl GpuBackend {
    /// Uploads what does not change in a run.
    pub(super) fn upload_stored(&self) -> Result<(), BackendError> {
        for (name, bytes) in [
            ("curve_points", bytemuck::cast_slice(&self.curve_points)),
            ("mesh_faces", bytemuck::cast_slice(&self.meshes.faces)),
            ("mesh_choices", bytemuck::cast_slice(&self.meshes.choices)),
            (
                "surface_corners",
                bytemuck::cast_slice(&self.surfaces.corners),
            ),
            ("solid_faces", bytemuck::cast_slice(&self.solids.rows)),
            ("spread_faces", bytemuck::cast_slice(&self.spreads.faces)),
            ("spread_edges", bytemuck::cast_slice(&self.spreads.edges)),
            (
                "spread_features",
                bytemuck::cast_slice(&self.spreads.features),
            ),
        ] {
            self.gpu.write(self.memory.named(name)?, 0, bytes)?;
        }
        Ok(())
    }

    pub(super) fn upload(&self, inputs: &FrameInputs) -> Result<(), BackendError> {
        let frame = Frame {
            page_len: self.memory.paging.page_len,
            page_count: self.memory.paging.page_count,
            ..inputs.frame
        };
        for (name, bytes) in [
            ("frame", bytemuck::bytes_of(&frame)),
            ("system_frames", bytemuck::cast_slice(&inputs.systems)),
            ("planets", bytemuck::cast_slice(&inputs.planets)),
            ("lamps", bytemuck::cast_slice(&inputs.lamps)),
            ("grounds", bytemuck::cast_slice(&inputs.grounds)),
            ("surfaces", bytemuck::cast_slice(&inputs.surfaces)),
            (
                "surface_light",
                bytemuck::cast_slice(&inputs.surface_lights),
            ),
            ("shade_box", bytemuck::cast_slice(&inputs.shade_boxes)),
            ("stroke_light", bytemuck::cast_slice(&inputs.stroke_lights)),
            ("pillars", bytemuck::cast_slice(&inputs.pillars)),
            ("poses", bytemuck::cast_slice(&inputs.poses)),
            ("broods", bytemuck::cast_slice(&inputs.broods)),
            ("row_spreads", bytemuck::cast_slice(&inputs.row_spreads)),
            ("bounds", bytemuck::cast_slice(&inputs.bounds)),
            ("winds", bytemuck::cast_slice(&inputs.winds)),
            ("layer_planes", bytemuck::cast_slice(&inputs.layer_planes)),
            ("flocks", bytemuck::cast_slice(&inputs.flocks)),
            ("relations", bytemuck::cast_slice(&inputs.relations)),
            ("obstacles", bytemuck::cast_slice(&inputs.obstacles)),
            ("fires", bytemuck::cast_slice(&inputs.fires)),
            ("listed_flames", bytemuck::cast_slice(&inputs.listed_flames)),
            ("light_roots", bytemuck::cast_slice(&inputs.light_roots)),
            ("age_looks", bytemuck::cast_slice(&inputs.age_looks)),
            ("spreads", bytemuck::cast_slice(&inputs.spreads)),
            ("spread_pieces", bytemuck::cast_slice(&inputs.spread_pieces)),
            ("due_ignitions", bytemuck::cast_slice(&inputs.due_ignitions)),
        ] {
            self.gpu.write(self.memory.named(name)?, 0, bytes)?;
        }
        let rows = self.memory.named("rows")?;
        for (slot, row) in inputs.rows.iter().enumerate() {
            let at = slot as u32 * self.row_count + frame.frame % self.row_count;
            let offset = u64::from(at) * size_of_val(row) as u64;
            self.gpu.write(rows, offset, bytemuck::bytes_of(row))?;
        }
        Ok(())
    }

    /// Submits the stages' dispatches in order.
    pub(super) fn submit(
        &mut self,
        stages: &[Stage],
        inputs: &FrameInputs,
    ) -> Result<(), BackendError> {
        self.submit_kernels(stages, |_| true, inputs)
    }

    /// Submits those of the stages' dispatches whose use of a kernel is `wanted`; a stage is over with
    /// its last kernel.
    pub(super) fn submit_kernels(
        &mut self,
        stages: &[Stage],
        wanted: impl Fn(&KernelUse) -> bool,
        inputs: &FrameInputs,
    ) -> Result<(), BackendError> {
        self.upload(inputs)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut timed = self.timer.as_mut().map(Timer::frame);
        for &stage in stages.iter().filter(|stage| stage.is_due(inputs)) {
            let all = &self.commands[self.current][&stage];
            let begins = all.first().is_some_and(|first| first.is_of(&wanted));
            if begins {
                let begin = |encoder: &mut _| self.memory.begin(stage, encoder);
                match &mut timed {
                    Some(timed) if self.memory.clears_light(stage) => {
                        timed.between_passes("draw/clear_light", &mut encoder, begin);
                    }
                    _ => begin(&mut encoder),
                }
            }
            let dispatches = self.memory.named("dispatches")?;
            let commands = all.iter().filter(|command| command.is_of(&wanted));
            match &mut timed {
                None => {
                    let mut pass = encoder.begin_compute_pass(&Default::default());
                    for command in commands {
                        command.encode(&mut pass, &self.kernels, dispatches);
                    }
                }
                Some(timed) => {
                    // A kernel's pages are one pass, so that their number is no bound.
                    let commands: Vec<_> = commands.collect();
                    for same in commands.chunk_by(|a, b| a.kernel == b.kernel) {
                        let mut pass = encoder.begin_compute_pass(&timed.pass(same[0].kernel));
                        for command in same {
                            command.encode(&mut pass, &self.kernels, dispatches);
                        }
                    }
                }
            }
            if all.last().is_some_and(|last| !last.is_of(&wanted)) {
                continue;
            }
            match stage {
                Stage::Front => self.points_moved = true,
                Stage::Insert => self.points_moved = false,
                Stage::Emit => self.newborns_present = true,
                Stage::Advance => {
                    self.newborns_present = false;
                    self.current = 1 - self.current;
                    self.ring
                        .stepped(&self.gpu, &self.memory, &mut encoder, inputs.frame.frame)?;
                }
                _ => {}
            }
        }
        if let Some(timed) = timed {
            timed.resolve(&mut encoder);
        }
        let submission = self.gpu.queue.submit([encoder.finish()]);
        self.ring.submitted();
        self.in_flight.push_back(submission);
        if self.in_flight.len() > FRAMES_IN_FLIGHT {
            let oldest = self.in_flight.pop_front();
            self.gpu.wait_for(oldest)?;
        }
        Ok(())
    }

    /// Brings all light to the limbs of its channels.
    pub(super) fn unpack_light(&self) -> Result<(), BackendError> {
        let Some(command) = self.unpack_command()? else {
            return Ok(());
        };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let dispatches = self.memory.named("dispatches")?;
            command.encode(&mut pass, &self.kernels, dispatches);
        }
        self.gpu.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Whether drivers have turned loops over boids as often as was asked for. They have where boids are few;
    /// where they are not, it is seen when anything is read.
    pub(super) fn check_overlooked(&self) -> Result<(), BackendError> {
        if !self.has_crowds {
            return Ok(());
        }
        let overlooked = self.memory.named("overlooked")?;
        // The second word tells kernels which frame has crowds.
        let counted = readback::words(&self.gpu, overlooked, 4)?;
        let counted: u64 = counted.into_iter().map(u64::from).sum();
        if counted == 0 {
            return Ok(());
        }
        Err(BackendError::Unsupported(format!(
            "boids are so crowded that {counted} of them, frame by frame, look at more others than its driver \
             lets a loop turn; with a smaller `count` or `perception_radius` it can"
        )))
    }

    pub(super) fn counts(&self) -> Result<Counts, BackendError> {
        let words = readback::words(
            &self.gpu,
            self.memory.named("counts")?,
            size_of::<Counts>() as u64,
        )?;
        Ok(bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words)))
    }

    pub(super) fn spread_counts(&self) -> Result<SpreadCounts, BackendError> {
        let words = readback::words(
            &self.gpu,
            self.memory.named("spread_counts")?,
            size_of::<SpreadCounts>() as u64,
        )?;
        Ok(bytemuck::pod_read_unaligned(bytemuck::cast_slice(&words)))
    }

    pub(super) fn digest_of(
        &mut self,
        commands: &[Command],
        at: usize,
    ) -> Result<u64, BackendError> {
        let digest = self.memory.named("digest")?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(digest, 0, None);
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let dispatches = self.memory.named("dispatches")?;
            for command in commands {
                command.encode(&mut pass, &self.kernels, dispatches);
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
        let words = readback::words(&self.gpu, digest, 16)?;
        Ok(u64::from(words[at]) | (u64::from(words[at + 1]) << 32))
    }
}
