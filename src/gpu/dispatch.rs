//! Dispatches in two dimensions. Twin of `wgsl/lib/dispatch.wgsl`.

/// Workgroups in a row; at most 65,535 fit one dimension.
pub const DISPATCH_WIDTH: u32 = 32_768;

/// Workgroups along x and y that cover `invocations` of them.
pub fn dispatch_for(invocations: u32, workgroup_size: u32) -> (u32, u32) {
    let groups = invocations.div_ceil(workgroup_size);
    (groups.min(DISPATCH_WIDTH), groups.div_ceil(DISPATCH_WIDTH))
}
