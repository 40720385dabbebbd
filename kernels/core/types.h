// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Structs that host and kernels share: 4-byte scalars and float4 only, padded explicitly, sizes
// asserted by the host (host/shared/shared_types.h) and probed on the device by the tests.
// All geometry is in scene units times SceneParams::unit, centred on the scene (kernel units).
#ifndef WEFT_KERNELS_CORE_TYPES_H
#define WEFT_KERNELS_CORE_TYPES_H

#define INVALID_INDEX 0xFFFFFFFFu
#define MAX_BOUNCES 8
#define MAX_CHOICE_VPLS 512  // in a list that vpl_choice.cl chooses from
// Words in which vpl_roulette.cl leaves what it decides on so many VPLs.
#define SURVIVAL_WORDS(vpls) (((vpls) + 3u) / 4u)
#define PACKET_BLOCK 16  // slots of one work list block share a sample set; a multiple of any LANES
// Shadow rays between two points end this share before the second: a receiver on the edge of two
// faces lies in the plane of both, and rounding must not let the other one block it.
#define SHADOW_END 0.9999847412109375f  // 1 - 2^-16
#define BVH_STACK 160                   // entries; the builder proves that no traversal needs more

// Features: what a frame must be able to do. A kernel compiled without one costs nothing for it.
#define FEATURE_TEXTURES 1u
#define FEATURE_VERTEX_COLOURS 2u
#define FEATURE_SMOOTH_NORMALS 4u
#define FEATURE_ENVIRONMENT 8u
#define FEATURE_PUNCTUAL_LIGHTS 16u
#define FEATURE_DIRECTIONAL_LIGHTS 32u
#define FEATURE_AREA_LIGHTS 64u
#define FEATURE_ONE_SIDED 128u
#define FEATURE_INDIRECT 256u        // the plan has indirect light
#define FEATURE_SAMPLED_DIRECT 512u  // and direct light that is filtered
#define FEATURE_EXACT_DIRECT 1024u   // and direct light that is not
#define FEATURE_DENSITY_GRIDS 2048u  // of media
#define FEATURE_MEDIA 4096u          // light goes through participating media
#define FEATURE_AIRLIGHT 8192u       // and what they scatter to the camera is in the plan
#define FEATURE_EMISSIVE_MEDIA 16384u
#define FEATURE_CONVEX_MEDIA 32768u  // MediaRecord::convex
#define FEATURE_TEMPORAL 65536u      // VPLs and irradiance records are stored from frame to frame
#define FEATURE_HEMISPHERES 131072u  // irradiance records trace hemispheres of rays
#define FEATURE_LOBES 262144u        // there are lobes other than Lambert's
#define FEATURE_EMISSION_TEXTURES 524288u
#define FEATURE_ORTHOGRAPHIC 1048576u       // rays of the camera are parallel
#define FEATURE_LIGHT_TREE 2097152u         // paths choose between several lights by a tree
#define FEATURE_IMAGE_ENVIRONMENT 4194304u  // the environment is an image
#define FEATURE_MATERIALS 8388608u          // paths scatter by SurfaceRecord
#define FEATURE_SEE_THROUGH 16777216u       // some let light pass straight on
#define FEATURE_REFLECTION 33554432u        // previews show what mirrors reflect
#define FEATURE_REFRACTION 67108864u        // what is seen through glass and gaps
#define FEATURE_GLOSSY 134217728u           // and what glossy surfaces reflect

// BVH child reference: EMPTY, or LEAF | count << 27 | first leaf triangle, or index of a node.
#define BVH_EMPTY 0xFFFFFFFFu
#define BVH_LEAF 0x80000000u
#define BVH_COUNT_SHIFT 27
#define BVH_COUNT_MASK 15u
#define BVH_FIRST_MASK 0x07FFFFFFu

// A wide node. bounds[2a] holds the lower, bounds[2a+1] the upper planes of axis a.
typedef struct {
    float bounds[6][8];
    uint child[8];
    uint pad[8];
} BvhNode;

// Triangles as traversal reads them. A leaf of n triangles, the first of which is entry f of all
// leaves, owns the floats [f LEAF_ROWS, (f + n) LEAF_ROWS): rows of n values each, one row for each
// coordinate (x, y, z of v0, of v1, of v2) and one for ids. Whole vectors are loaded from a row, so
// what follows is read and dropped; ids therefore are bits of ordinary floats, and NODE_WIDTH
// floats follow the last leaf.
#define LEAF_ROWS 10
#define LEAF_ID_ROW 9
#define LEAF_ID_FLAG 0x40000000u
#define LEAF_ID_MASK 0x07FFFFFFu

typedef struct {
    uint v0, v1, v2;  // vertex indices, counter-clockwise seen from outside
    uint instance;
} Triangle;

typedef struct {
    uint material;
    uint first_triangle;  // id of the instance's first triangle
    uint light;           // index of its area light, or INVALID_INDEX
    uint emission_uv;     // what leads from a vertex to its texture coordinates for emission
} InstanceRecord;

#define MATERIAL_TWO_SIDED 1u
#define MATERIAL_EMITS 2u
#define MATERIAL_EMITS_BOTH_SIDES 4u

typedef struct {
    float4 albedo;      // rgb, of the diffuse part of a surface
    float4 emission;    // rgb, W/(m^2 sr)
    float4 parameters;  // of lobes other than Lambert's, as each defines them
    uint flags;
    uint texture;           // index or INVALID_INDEX
    uint lobe;              // LOBE_* of bsdf/lobe.h
    uint emission_texture;  // that `emission` is multiplied with; index or INVALID_INDEX
} MaterialRecord;

#define TEXTURE_NEAREST 1u
#define TEXTURE_SRGB 2u
#define TEXTURE_ALPHA 4u        // look-ups are of alpha, which is linear
#define TEXTURE_WRAP_U_SHIFT 4  // two bits: 0 repeat, 1 clamp, 2 mirror
#define TEXTURE_WRAP_V_SHIFT 6

// A texture's mip levels follow one another, each half as large, down to one texel.
typedef struct {
    uint offset;  // first texel of level 0
    uint width, height;
    uint flags;
} TextureRecord;

// Channels of a map that a number takes.
#define CHANNEL_COLOUR 0u
#define CHANNEL_RED 1u
#define CHANNEL_GREEN 2u
#define CHANNEL_BLUE 3u
#define CHANNEL_ALPHA 4u
#define CHANNEL_LUMINANCE 5u

// A texture of a parameter of a surface, and where it lies: (s, t) = to_s, to_t times (u, v, 1) of
// a set of texture coordinates.
typedef struct {
    float4 to_s, to_t;  // xyz
    uint texture;
    uint uv_set;
    uint channel;
    uint pad;
} SurfaceMap;

#define SURFACE_UV_SETS 8u  // of a mesh
// Words of an instance: what leads from a vertex to its coordinates in each set, then the number of
// the interface that it is, what leads to the alpha of vertices, in place of coordinates, and the
// number of the boundary of a medium that it is, where the flag tells that what is before its
// normals is inside of that. Each of these three may be INVALID_INDEX.
#define SURFACE_INTERFACE SURFACE_UV_SETS
#define SURFACE_VERTEX_ALPHA (SURFACE_UV_SETS + 1u)
#define SURFACE_BOUNDARY (SURFACE_UV_SETS + 2u)
#define SURFACE_BOUNDARY_INWARDS 0x80000000u
#define SURFACE_INSTANCE_WORDS (SURFACE_UV_SETS + 3u)

// Parameters that a map may multiply; a record's maps follow one another in this order.
#define MAP_BASE 1u  // base colour, or diffuse reflectance
#define MAP_METALLIC 2u
#define MAP_ROUGHNESS 4u
#define MAP_ROUGHNESS_V 8u
#define MAP_SPECULAR 16u
#define MAP_SPECULAR_COLOUR 32u
#define MAP_TRANSMISSION 64u
#define MAP_ANISOTROPY 128u
#define MAP_COAT 256u
#define MAP_COAT_ROUGHNESS 512u
#define MAP_COAT_NORMAL 1024u
#define MAP_NORMAL 2048u
#define MAP_ALPHA 4096u

// How a surface scatters light, SurfaceRecord::model.
#define SURFACE_LAYERED 0u  // kernels/bsdf/layered.h
#define SURFACE_PLASTIC 1u  // kernels/bsdf/plastic.h
#define SURFACE_UNLIT 2u    // shows `base` and scatters nothing
#define SURFACE_LAMBERT 3u  // by MaterialRecord alone

#define SURFACE_THIN 1u       // what transmits is a wall without thickness
#define SURFACE_CONDUCTOR 2u  // a metal by its index
#define SURFACE_SINGLE_SCATTER 4u
#define SURFACE_BECKMANN 8u
#define SURFACE_SEPARABLE 16u
#define SURFACE_LOCAL_INDEX 32u      // indices as given, whatever lies around
#define SURFACE_SPECULAR_SCALES 64u  // the base is multiplied by 1 less the largest channel of f0
#define SURFACE_NONLINEAR 128u       // of SURFACE_PLASTIC
#define SURFACE_MASK 512u            // there where alpha is not below the cut-off
#define SURFACE_BLEND 1024u          // there by the share alpha
#define SURFACE_ROOT_TINT 256u       // each crossing is tinted by the root of the base
// Colours of the reflection and of what is transmitted are factors of Fresnel's exact shares.
#define SURFACE_EXACT_FRESNEL 16384u
// Of normal maps as Mitsuba has them: mitsuba_normal, kernels/bsdf/surface_frame.h.
#define SURFACE_MITSUBA_NORMALS 2048u
#define SURFACE_NORMAL_SHADOWING 4096u  // tilted facets shade: normal_shadowing
#define SURFACE_NORMAL_FLIP 8192u       // normals that face away are turned about the surface's
// Of view_chains.cl: the surface may reflect as a mirror, be seen through, or be glossy.
#define SURFACE_MIRRORS 32768u
#define SURFACE_LETS_THROUGH 65536u
#define SURFACE_GLOSSY 131072u
#define SURFACE_ROUGH_GLASS 262144u  // it is seen through rough facets

// Scales of roughness.
#define ROUGHNESS_SQUARED 0u   // alpha is its square
#define ROUGHNESS_GLOSS 1u     // alpha is (1 - x)^2
#define ROUGHNESS_ALPHA 2u     // alpha itself
#define ROUGHNESS_EXPONENT 3u  // of Phong's lobe: alpha is sqrt(2 / (x + 2))

// The parameters of a material, each a factor of its map.
typedef struct {
    float4 base;      // rgb; w metallic
    float4 specular;  // rgb of the reflection at normal incidence; w its strength
    float4 eta;       // rgb of a metal; x of a dielectric: index within over index outside
    float4 k;         // rgb of a metal; x of a dielectric: eta^2 - 1; y: that of 1 / eta
    float roughness_u, roughness_v;
    uint roughness_scale;
    float transmission;
    float anisotropy, rotation;
    float coat, coat_roughness;
    float normal_scale, coat_normal_scale;
    float weight;  // of SURFACE_PLASTIC: see kernels/bsdf/plastic.h
    float inner;   // of SURFACE_PLASTIC: share of light from inside that is reflected
    uint model, flags;
    uint maps, first_map;
    uint table;           // first value of its tables, or INVALID_INDEX
    float alpha, cutoff;  // of SURFACE_MASK and SURFACE_BLEND
    uint pad;
} SurfaceRecord;

// A solid dielectric. Those that enclose less are numbered first: within several, the first counts.
typedef struct {
    float4 sigma_a;  // rgb, absorption per kernel unit
    float index;
    uint is_local;  // 1 where `index` is relative to what lies around, whatever that is
    uint pad[2];
} InterfaceRecord;

// Kinds of lights. An area light is the emissive triangles [first, first + count) of the emitter
// list.
#define EMITTER_AREA 0u
#define EMITTER_POINT 1u
#define EMITTER_SPOT 2u
#define EMITTER_DIRECTIONAL 3u
#define EMITTER_ENVIRONMENT 4u

// One light. `cumulative` is the inclusive sum of choice probabilities up to this light.
typedef struct {
    float4 position;  // punctual: xyz; area: middle of its corners, w: distance of the furthest
                      // one; of a spot w: the angle between its cones, in radians, where it falls
                      // off linearly with the angle, or 0
    float4 axis;      // spot, directional: direction of travel; area: xyz normal of one flat
                      // panel (host/scene/area_light_bounds.h), else 0; of a spot that falls off
                      // linearly w: the angle of its outer cone
    float4 power;     // area: radiance, without texture; point, spot: W/sr in kernel units;
                      // directional: W/m^2; environment: SceneParams::environment
    uint kind;
    uint first, count;  // emissive triangles
    float area;         // kernel units squared; of a textured one what shines
    float cumulative;
    float probability;
    float cos_inner, cos_outer;
    uint both_sides;
    float area_cumulative;  // the same among the area lights alone; 0 for other lights
    float area_probability;
    float choice_cumulative;  // the same for path tracing, which chooses from all but environments
                              // of the same radiance everywhere
    float choice_probability;
    uint enclosing_media;  // media boundaries about its centre, a bit each
    uint textured;         // area: 1 where its radiance is not the same everywhere
    uint node;             // its leaf of the light tree, of FEATURE_LIGHT_TREE
} LightRecord;

// A node of the light tree (light_tree.h), by the bounds of its lights.
#define LIGHT_BALL 0u             // shines in all directions from somewhere in the ball
#define LIGHT_PANEL 1u            // from flat panels of one normal, `axis`
#define LIGHT_TWO_SIDED_PANEL 2u  // one panel, both sides of which shine
#define LIGHT_SPOT 3u
#define LIGHT_DISTANT 4u      // travels along `axis`, from nowhere
#define LIGHT_ALL_DISTANT 5u  // several of these
#define LIGHT_ALL_AROUND 6u   // shines from all directions, more so from along `axis`
#define LIGHT_CHILDREN 8u     // most of a node
typedef struct {
    float4 position;  // xyz middle of a ball that holds the lights, w its radius
    float4 axis;      // w of LIGHT_PANEL: how high above the middle, along the normal, panels may
                      // be; of LIGHT_SPOT: the cosine of its edge; xyz of LIGHT_ALL_AROUND: its dot
                      // product with a normal, plus 1, is about how many times its mean the
                      // irradiance is
    float intensity;  // of light leaving along the axis, over that of the scene's brightest light:
                      // radiance times area, W/sr, or of distant light its irradiance, of
                      // LIGHT_ALL_AROUND the mean of that over all normals
    uint shape;
    uint first, count;  // children; where count is 0, `first` is the light
    uint parent;
    uint pad[3];
} LightNode;

// An emissive triangle; `cumulative` is relative to its light, by area, of a textured one by area
// times mean radiance. The entries of a textured light are all triangles of its instance, in order.
typedef struct {
    uint triangle;
    float cumulative;
    float probability;
    float density;  // of points that are chosen on it: 1 / kernel unit squared
} EmissiveTriangle;

// A virtual point light, or a sample point on a light. Irradiance at x with unit normal n:
// flux * min(G, bound) for VPL_SURFACE, flux * cos / d^2 for VPL_POINT, times the cone for
// VPL_SPOT; flux * min(phase function * cos / d^2, bound / pi) for VPL_MEDIUM, a point of a medium.
#define VPL_SURFACE 0u
#define VPL_POINT 1u
#define VPL_SPOT 2u
#define VPL_MEDIUM 3u

#define NO_BOUND 1e30f  // above every G

typedef struct {
    float4 position;  // xyz, offset to the lit side; w: bound on G, 1/unit^2
    float4 normal;    // xyz unit, of VPL_MEDIUM the direction in which light came; w: kind (bits)
    float4 flux;  // rgb: reflected flux over pi, summed over all sets; 0: unused; w: of indirect
                  // VPLs their random number for roulette, in (0, 1]
    float4 cone;  // spot: cos_inner, cos_outer, or where it falls off linearly with the angle the
                  // angles of its outer cone and, in z, between its cones, which else is 0;
                  // VPL_MEDIUM: x is the phase function's g; w: random number of its place on view
                  // rays through media, in [0, 1)
} Vpl;

// An image of the environment: radiance by direction, over SceneParams::environment. A direction
// has the coordinates u, how far it is turned about the image's axis y, and v, its angle from that
// axis, both in [0, 1]; see environment_image.h. Beyond each edge of the image there is one texel
// more, the one that is next to it on the sphere, so that looking up needs no wrapping.
typedef struct {
    float4 x_axis, y_axis, z_axis;  // of the image, unit vectors in kernel space
    uint width, height;             // texels, with those beyond the edges
    float column_scale;             // columns of the image
    float row_scale, row_offset;    // row of the texels of that v: their sum with v times the first
    // Cells of the same solid angle by which directions are chosen, `rows` of the cosine of v times
    // `columns` of u.
    uint columns, rows;
    uint pad;
} EnvironmentRecord;

// A medium's densities and their majorants, floats of two buffers from `first` and `first_bound`
// on, of nx ny nz voxels and bx by bz blocks; see host/scene/density_grid.h and majorant_grid.h.
typedef struct {
    uint nx, ny, nz;
    uint first;
    uint bx, by, bz;
    uint first_bound;
    uint block;      // voxels along the edge of a block, a power of two
    float greatest;  // density
    // 3 where densities have a colour: the voxels' greatest of red, green and blue come first,
    // which bounds refer to, then each of these; or of an albedo these alone. Else 1.
    uint channels;
    uint pad;
    float4 to_x, to_y, to_z;  // rows of the affine map from kernel space to the unit cube
} DensityGridRecord;

// Participating media (medium_walk.h). Space outside all boundaries, and what each boundary
// encloses, is of one medium or clear. Where boundaries overlap, the lowest number counts: the
// host numbers them by volume, the smallest first.
#define MAX_MEDIUM_BOUNDARIES 32
#define NO_MEDIUM 0xFFFFFFFFu
#define MEDIA_EVERYWHERE 1e30f  // reach of a box without end
#define CONVEX_BOUNDARIES 8u
#define CONVEX_PLANES 64u

typedef struct {
    float4 sigma_t;   // rgb extinction, 1 / kernel unit; w: of a grid whose densities have a colour
                      // that of all channels, of which rgb is the mean over the grid; else 0
    float4 albedo;    // rgb share of it that is scattered; the mean of `albedo_grid`
    float4 emission;  // rgb radiance emitted per kernel unit of length
    float anisotropy;  // Henyey-Greenstein g
    uint grid;         // of densities that multiply sigma_t and emission; INVALID_INDEX: none
    uint albedo_grid;  // likewise; INVALID_INDEX: the same everywhere
    uint pad;
} MediumRecord;

typedef struct {
    uint interior[MAX_MEDIUM_BOUNDARIES];  // medium or NO_MEDIUM, by boundary
    uint outside;                          // of all boundaries
    uint boundaries;                       // how many there are
    uint around_camera;                    // a bit for each boundary that encloses the camera
    float rounding;                        // how far rounding may move a boundary, kernel units
    float4 box_centre, box_reach;          // half the box outside of which all is clear
    // 1 where all boundaries are convex, each two apart or one inside of the other, and no grid
    // lies around another boundary; then what follows tells where they are (convex_media.h).
    uint convex;
    uint pad0, pad1, pad2;
    uint plane_end[CONVEX_BOUNDARIES];  // of the planes of boundaries up to this one
    uint around[CONVEX_BOUNDARIES];     // the next boundary around it; NO_MEDIUM: none
    float4 planes[CONVEX_PLANES];       // unit normal outwards; w: dot product of points with it
} MediaRecord;

// An irradiance record: irradiance at a place, and its gradients; see cache_records.cl and
// hemisphere_records.cl.
typedef struct {
    float4 position;   // xyz; w: radius, up to which the record serves, kernel units
    float4 origin;     // where its rays start: xyz, moved off its surface
    float4 normal;     // shading normal; w: 1 where something may hide places that it serves
    float4 clear_low;  // by sector: squared distance up to which nothing can hide a place
    float4 clear_high;
    float4 irradiance;                       // rgb
    float4 move_red, move_green, move_blue;  // gradient over place, per kernel unit
    float4 turn_red, turn_green, turn_blue;  // gradient over turns of the normal, by n x n'
} CacheRecord;

// Tiles of the adaptive components, TILE_EDGE pixels square. A bit of a mask is a pixel, row by
// row; the first word is the upper half.
#define TILE_EDGE 8
#define TILE_SMOOTH 1u  // one smooth surface, and so are the coarse lattice points about it

// Of the neighbour bits of a lattice point (lattice_signal.cl): it has a sample itself.
#define LATTICE_SAMPLED 256u

typedef struct {
    uint lit[2];     // pixels that have an irradiance
    uint middle[2];  // too few of whose taps at stride 4 are on their surface, but enough at 2
    uint fine[2];    // that need samples of their own
    uint flags;
    uint pad;
} TileRecord;

// Nodes of the map of the environment's irradiance, along each of its axes.
#define IRRADIANCE_NODES 65u

// Edge of the squares of pixels that see different facets of rough surfaces (view_chains.cl).
#define GLOSSY_PATTERN 9u

// Most further rays of an edge pixel; an even number, since they lie about its centre in pairs.
#define MAX_EDGE_SAMPLES 8u

/// Width of the block of pixels whose primary rays make a packet (gbuffer.cl), in pixels; its
/// height is `lanes` over that.
static inline uint pixel_block_width(uint lanes) {
    return lanes >= 8u ? 4u : (lanes >= 4u ? 2u : 1u);
}

/// Edge pixels that one work-item of edge_samples.cl takes: as many as fill a packet.
static inline uint edge_pixels_of_item(uint lanes, uint samples) {
    return lanes > samples ? lanes / samples : 1u;
}

// Slopes of brightness_slope by the leading bits of a float: sign, exponent and three bits of the
// mantissa, up to infinity; within 6 % of any slope.
#define SLOPE_DROPPED_BITS 20u
#define SLOPE_ENTRIES (0x7F800000u >> SLOPE_DROPPED_BITS)

// Counters of one launch, 64 bit in two halves.
typedef struct {
    uint rays_low, rays_high;
    uint misses;  // edge samples on surfaces that no pixel about them shows
    uint pad;
} RayCounter;

#define COMPONENT_EMISSION 0
#define COMPONENT_DIRECT 1
#define COMPONENT_INDIRECT 2
#define COMPONENT_SURFACE 3  // albedo, normal and depth
#define COMPONENT_MEDIA 4
#define COMPONENT_REFLECTION 5
#define COMPONENT_REFRACTION 6
#define COMPONENT_GLOSSY 7
#define COMPONENT_COUNT 8

typedef struct {
    uint count[COMPONENT_COUNT];
    uint first_pixel[COMPONENT_COUNT];
    uint pad[2];
} NonfiniteCounter;

// Film planes, each width * height floats, in this order, FILM_STRIDE apart; sums over samples.
#define FILM_EMISSION 0
#define FILM_DIRECT 3
#define FILM_INDIRECT 6
#define FILM_ALBEDO 9
#define FILM_NORMAL 12
#define FILM_DEPTH 15
#define FILM_ALPHA 16
#define FILM_PLANES 17
// Films of previews have three further planes for each of these that their features name, in this
// order: light that media scatter to the camera (FEATURE_AIRLIGHT), what is seen in mirrors
// (FEATURE_REFLECTION), through glass and gaps (FEATURE_REFRACTION) and on glossy surfaces
// (FEATURE_GLOSSY).
#define FILM_MEDIA 17
static inline uint film_reflection_plane(uint features) {
    return FILM_PLANES + ((features & FEATURE_AIRLIGHT) != 0u ? 3u : 0u);
}
static inline uint film_refraction_plane(uint features) {
    return film_reflection_plane(features) + ((features & FEATURE_REFLECTION) != 0u ? 3u : 0u);
}
static inline uint film_glossy_plane(uint features) {
    return film_refraction_plane(features) + ((features & FEATURE_REFRACTION) != 0u ? 3u : 0u);
}
/// How many planes the film of a preview has.
static inline uint film_plane_count(uint features) {
    return film_glossy_plane(features) + ((features & FEATURE_GLOSSY) != 0u ? 3u : 0u);
}
// Values from one plane to the next. Planes of a power of two would all meet in the same few lines
// of a cache: composition took three times as long.
#define FILM_STRIDE(pixels) ((pixels) + 80u)

// The film of path tracing holds exact sums (film_sums.h): FILM_SUM_WORDS words for each of the
// planes above, then FILM_SQUARE_WORDS words for the squares of each channel of the image.
// A sum counts 2^-FILM_SUM_SHIFT of its unit, which is 1 / PathParams::film_scale for light.
#define FILM_SUM_WORDS 3
#define FILM_SUM_SHIFT 52
#define FILM_SQUARE_WORDS 4
#define FILM_SQUARE_SHIFT 72
#define FILM_PIXEL_WORDS 63

// The camera and the image it makes: the ray through film point (s, t) in [-1,1]^2, +t up, begins
// at the origin in the direction forward + s right + t up; that of an orthographic camera begins at
// origin + s right + t up in the direction forward.
typedef struct {
    float4 origin;   // w: of orthographic cameras, its distance from the camera, kernel units
    float4 forward;  // unit
    float4 right;
    float4 up;
    float jitter_x, jitter_y;  // of primary rays, in pixels, from the pixel's corner
    // Of orthographic cameras, both are widths in kernel units in place of angles.
    float pixel_angle;       // radians between neighbouring pixels at the centre
    float texture_angle;     // angle over which primary rays average textures
    uint width, height;      // of the image, pixels
    uint hides_environment;  // 1: rays that meet nothing show none
    uint own_jitter;         // 1: each pixel has a random jitter of its own instead
} CameraParams;

// The scene as all kernels see it. Lights lie in the light table by kind: area lights, then point
// and spot lights, directional lights, the environment.
typedef struct {
    float4 environment;      // rgb radiance; of an image what its texels are multiplied with
    float4 bounding_sphere;  // xyz centre; w: radius, kernel units
    float unit;              // kernel units per scene unit, a power of two
    float extent;            // largest |coordinate| of geometry and camera, kernel units
    uint lights;             // entries of the light table
    uint area_lights;        // among them, the first entries
    uint delta_lights_first, delta_lights;  // point and spot lights that the plan samples
    uint directional_lights_first, directional_lights;
    uint choice_lights;  // lights that next-event estimation chooses from, the first entries
    uint pad[3];
} SceneParams;

// How many points on area lights a sample set has.
typedef struct {
    uint per_light;     // points of each light; 0: `per_set` are chosen by power
    uint per_set;       // of all lights
    float bound_scale;  // bound on G of a point: this / area of its light
    uint pad;
} LightSampling;

// What the plan samples.
typedef struct {
    LightSampling lights;
    uint seed;
    uint sample;               // number of the sample that is made, from 0 on
    uint sets;                 // sample sets made for each sample
    uint gather_sets;          // sets the work list chooses from
    uint set_rotation;         // of the sets among the pixels, by sample
    uint interleave;           // edge of the squares of pixels that hold every set once
    float gather_scale;        // a set's sum times this estimates the whole sum
    float vpl_bound;           // bound on G of indirect VPLs
    uint environment_samples;  // rays per pixel
    uint paths_per_set;
    uint walked_per_set;  // VPLs that the light paths of a set leave
    uint bounces;
    uint survivors[MAX_BOUNCES];  // paths of a set that reach bounce k + 1
    uint first_vpl[MAX_BOUNCES];  // their first slot inside the set
    uint edge_samples;            // further rays of an edge pixel, even; 0: none
    float record_error;           // relative error that the radius of irradiance records allows
    uint most_bounces;            // scatterings after which paths of path tracing end
    uint pad;
} SamplingParams;

// What belongs to the same surface in reconstruction (discontinuity buffer).
typedef struct {
    uint radius;           // of the filter footprint, pixels
    float cosine;          // least cosine between normals
    float planes;          // largest distance from the plane, in footprints of a pixel
    float enough_support;  // of the weight of a lattice's taps, what a pixel needs on its surface
} FilterParams;

// What all kernels of a sample share.
typedef struct {
    CameraParams camera;
    SceneParams scene;
    SamplingParams sampling;
    FilterParams filter;
    uint features, pad[3];  // FEATURE_*
} RenderParams;

// The work-items of one launch, filled in by the executor, and where it counts its rays.
typedef struct {
    uint first, count;  // [first, first + count)
    uint counter;       // which RayCounter
    uint spread;        // of its work groups, see WORK_ITEM: coprime to their number
} LaunchRange;

// Entries of a list by sample set: those of set k are the `length` from first + k stride on.
typedef struct {
    uint first, stride, length;
} SetList;

// The cells of the hemispheres that a launch samples, of the records in slots from `first` on.
typedef struct {
    uint first, elevations, azimuths;
} HemisphereGrid;

// How irradiance records gather VPLs, and which of them are computed again after a change.
typedef struct {
    uint vpls;
    float roulette;    // as of vpl_gather
    uint mask_words;   // words of a packet's bits by VPL (cache_masks.h); 0: none are stored
    uint moved_boxes;  // see moved.h
} RecordUpdate;

// The samples of every pixel in one launch of the path tracer, from SamplingParams::sample on.
typedef struct {
    uint samples;
    uint through_centres;  // 1: all of them go through the pixel's centre
    float film_scale;      // a power of two that brings the scene's light to about 1
} PathParams;

#endif
