// Dispatches in two dimensions: at most 65,535 workgroups fit one, so a long list of invocations
// is folded into rows of DISPATCH_WIDTH workgroups. Twin of gpu/dispatch.rs.
#define_import_path motes::dispatch

#import motes::layout::Dispatch

const DISPATCH_WIDTH: u32 = 32768u;

// Workgroups that cover `invocations` of them.
fn dispatch_for(invocations: u32, workgroup_size: u32) -> Dispatch {
    let groups = (invocations + workgroup_size - 1u) / workgroup_size;
    let rows = (groups + DISPATCH_WIDTH - 1u) / DISPATCH_WIDTH;
    return Dispatch(min(groups, DISPATCH_WIDTH), rows, select(0u, 1u, groups > 0u));
}

// Where an invocation stands in the list.
fn linear_index(global_id: vec3<u32>, workgroup_size: u32) -> u32 {
    return global_id.x + global_id.y * (DISPATCH_WIDTH * workgroup_size);
}

// Where, among the dispatches, those that are not of pages begin.
fn first_spare(page_count: u32) -> u32 {
    return 2u + 4u * page_count + page_count * (page_count + 1u) / 2u;
}
