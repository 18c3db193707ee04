//! The entry that reads the pixels of a cell, several a lane: lines for each of them, since arrays of lobes that a
//! loop indexes are neither held in registers nor compiled in bearable time.

/// Its text, for so many pixels a lane.
pub(crate) fn sorted_entry(pixels: usize) -> String {
    let each = |text: fn(usize) -> String| (0..pixels).map(text).collect::<String>();
    let list = |text: fn(usize) -> String| (0..pixels).map(text).collect::<Vec<_>>().join(", ");
    let lobe = |p| {
        format!(
            "
    let number{p} = order[slot + {p}u * LANES];
    // Where there is no pixel any will do.
    let surface{p} = surfaces[max(number{p}, 1u) - 1u];
    let r{p} = reflectance(surface{p}, view.camera);
    let lobe{p} = world_lobe(r{p});
    let local{p} = local_of(surface{p}.position);
    var radiance{p} = vec3f();
"
        )
    };
    let write = |p| {
        format!(
            "
    if (number{p} != 0u) {{
        pixels[number{p} - 1u] += vec4f(reflected(r{p}, radiance{p}), 0.0);
    }}"
        )
    };
    format!(
        "import package::bindings::{{block, order, pixels, surfaces, view}};
import package::corner::corner_radiance;
import package::layout::LANES;
import package::place::in_cells;
import package::receiver::reflectance;
import package::weights::corner_weights;
import package::world_lobe::{{reflected, world_lobe}};

@compute @workgroup_size(LANES)
fn read_cell(
    @builtin(local_invocation_index) lane: u32,
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
) {{
    let slot = block.first + (group.y * groups.x + group.x) * {pixels}u * LANES + lane;
{}
    for (var corner = 0u; corner < 8u; corner++) {{
        let sums = corner_radiance({}, corner, {});{}
    }}
{}
}}

fn local_of(position: vec3f) -> vec3f {{
    return clamp(in_cells(position) - vec3f(block.cell), vec3f(), vec3f(1.0));
}}
",
        each(lobe),
        list(|p| format!("lobe{p}")),
        list(|p| format!("corner_weights(local{p}, corner)")),
        each(|p| format!("\n        radiance{p} += sums[{p}];")),
        each(write),
    )
}
