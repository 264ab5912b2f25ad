// Light of a pixel in one word, for adapters that add 64-bit words atomically.
//
// Three fields, one a channel, hold steps of light (motes::light); what overflows a field goes on to
// the limbs of its channel. Fields and limbs together are what the limbs alone would be, in whatever
// order the additions came: how often a field overflows is told by their sum.
#define_import_path motes::packed

// Fields of red, green and blue, from bit 0.
const GREEN_AT: u32 = 21u;
const BLUE_AT: u32 = 42u;
// Steps that do not fit a field of red or green, of blue.
const FIELD_LEN: u32 = 0x200000u;
const BLUE_LEN: u32 = 0x400000u;
// The bit of what is left that tells of steps that did not fit.
const UNFIT: u32 = 8u;

// What of the steps fits the fields of a packed pixel.
fn packed(steps: vec3<u32>) -> u64 {
    return u64(steps.x & (FIELD_LEN - 1u))
        | (u64(steps.y & (FIELD_LEN - 1u)) << GREEN_AT)
        | (u64(steps.z & (BLUE_LEN - 1u)) << BLUE_AT);
}

// Which fields ran over when `word`, packed of `steps`, was added to a pixel that held `before`, a
// bit each; and UNFIT where steps were too many for their field. 0 where nothing is left.
fn rest_of(before: u64, word: u64, steps: vec3<u32>) -> u32 {
    let sum = before + word;
    let carries = before ^ word ^ sum;
    let of_red = u32(carries >> GREEN_AT) & 1u;
    let of_green = u32(carries >> BLUE_AT) & 1u;
    let of_blue = select(0u, 4u, sum < before);
    let unfit = select(0u, UNFIT, (steps.x | steps.y | (steps.z >> 1u)) >= FIELD_LEN);
    return of_red | (of_green << 1u) | of_blue | unfit;
}

// What is then left for the limbs: what did not fit, and what ran over. What ran over from a field
// was added to the one after it, and is taken off there: a count of -1 has all bits set.
fn left_over(rest: u32, steps: vec3<u32>) -> vec3<u32> {
    let of_red = rest & 1u;
    let of_green = (rest >> 1u) & 1u;
    let of_blue = (rest >> 2u) & 1u;
    let unfit = steps - unpacked(packed(steps));
    let ran_over = vec3<u32>(of_red * FIELD_LEN, of_green * FIELD_LEN, of_blue * BLUE_LEN);
    return unfit + ran_over - vec3<u32>(0u, of_red, of_green);
}

// A bit for each channel that has steps left.
fn channels_of(over: vec3<u32>) -> u32 {
    return select(0u, 1u, over.x != 0u) | select(0u, 2u, over.y != 0u) | select(0u, 4u, over.z != 0u);
}

// The steps in the fields of a packed pixel.
fn unpacked(word: u64) -> vec3<u32> {
    return vec3<u32>(
        u32(word) & (FIELD_LEN - 1u), u32(word >> GREEN_AT) & (FIELD_LEN - 1u), u32(word >> BLUE_AT),
    );
}
