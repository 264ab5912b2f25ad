//! A stage as a device runs it, with everything that it reads: enough to run it alone elsewhere.

/// One stage of one frame, just before it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageRecord {
    /// The driver's name for the adapter.
    pub adapter: String,
    /// Driver and its version.
    pub driver: String,
    /// The kernels that the stage runs, each once.
    pub kernels: Vec<KernelRecord>,
    /// What the stage dispatches, in order; each sees what those before it wrote.
    pub dispatches: Vec<DispatchRecord>,
    /// Every buffer that a dispatch binds, whole, as it is before the stage.
    pub buffers: Vec<BufferRecord>,
}

/// A kernel as it was handed to the driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KernelRecord {
    /// Name, e.g. `particles/advance`.
    pub name: String,
    /// Name of the entry point in both texts.
    pub entry_point: String,
    /// Invocations in a workgroup.
    pub workgroup_size: [u32; 3],
    /// SPIR-V words.
    pub spirv: Vec<u32>,
    /// The same as plain WGSL.
    pub wgsl: String,
}

/// One dispatch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DispatchRecord {
    /// Name of its kernel.
    pub kernel: String,
    /// How many workgroups.
    pub groups: Groups,
    /// Words of its immediates, from byte 0.
    pub immediates: Vec<u32>,
    /// Buffers of group 0 by number of the binding: names of [`StageRecord::buffers`].
    pub bindings: Vec<BindingRecord>,
}

/// Workgroups of a dispatch along x, y and z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Groups {
    /// These.
    Direct([u32; 3]),
    /// Three words of the buffer `dispatches`, from three times this index on.
    Listed(u32),
}

/// One bound buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BindingRecord {
    /// Number in group 0.
    pub binding: u32,
    /// Name of the variable in WGSL.
    pub variable: String,
    /// Name of the buffer.
    pub buffer: String,
    /// `uniform`, `read` or `read_write`.
    pub access: &'static str,
}

/// A buffer's contents.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferRecord {
    /// Name; a page of a pool has its number behind it: `particles-0`.
    pub name: String,
    /// All of its words.
    pub words: Vec<u32>,
}

impl StageRecord {
    /// The recorded buffer of that name.
    pub fn buffer(&self, name: &str) -> Option<&BufferRecord> {
        self.buffers.iter().find(|buffer| buffer.name == name)
    }
}
