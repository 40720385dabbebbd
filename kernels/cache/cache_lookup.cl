// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Looks up the irradiance of the pixels of a tile: the weighted mean of the records about them,
// each extrapolated to first order (Ward and Heckbert 1992). A record serves a place x with normal
// n' with the weight
//   1 - |x - x_i|^2 / R_i^2 - (1 - n.n') / e,
// where e is SamplingParams::record_error, and 1 - n.n' is by how much a turn changes light that
// comes along the normal beyond the first order. The weight has no steps. It counts as 0 where x
// lies behind the record's surface, or where x is beyond the record's clearance and a ray between
// the two is blocked. Pixels with too little weight stay in `missing`, where the host places
// records.
//
// Records of hemispheres (FEATURE_HEMISPHERES) have the weights of Ward, Rubinstein and Clear 1988,
// 1 / error - 1 / e with the error |x - x_i| e / R_i + sqrt(1 - n.n'), here times e.
//
// A launch adds new records to the means, and their weights, of earlier launches. One work-item per
// tile.
#include "kernels/adaptive/tile_footprint.h"
#include "kernels/cache/cache.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/offset.h"
#include "kernels/light/connection.h"
#include "kernels/media/packet_media.h"

// Least error of a record, as a share of the allowed one: without it Ward's weights have no bound.
#define LEAST_ERROR_SHARE 0.0009765625f  // 2^-10
// Weight up to which a pixel is missing.
#define ENOUGH_WEIGHT 0.1f

// The bounds of a tile's surfaces.
typedef struct {
    float3 lower, upper;
} TileBox;

static inline int boxes_meet(const TileBox* box, float4 lower, float4 upper) {
    return box->lower.x <= upper.x && box->lower.y <= upper.y && box->lower.z <= upper.z &&
                   box->upper.x >= lower.x && box->upper.y >= lower.y && box->upper.z >= lower.z
               ? 1
               : 0;
}

static inline int record_meets(const TileBox* box, float4 record) {
    float3 p = xyz(record);
    float3 apart = p - lowest3(highest3(p, box->lower), box->upper);
    return dot3(apart, apart) < record.w * record.w ? 1 : 0;
}

// A tile's pixels, and weighted sums of irradiance; loaded once a record may serve it.
typedef struct {
    TileFootprint footprint;
    float red[TILE_EDGE][TILE_EDGE];
    float green[TILE_EDGE][TILE_EDGE];
    float blue[TILE_EDGE][TILE_EDGE];
    float weight[TILE_EDGE][TILE_EDGE];
    int loaded;
} CachedTile;

/// Ward's weights, below 0 where the record does not serve: of squared distances and 1 - cosines.
static inline NFloat ward_weights(const RenderParams* params, float radius, NFloat square,
                                  NFloat turned) {
    float least_turn =
        m_max(params->sampling.record_error * params->sampling.record_error, LEAST_TURN);
    NFloat share = node_square_root(VMAX(turned, NODE(0.0f)) * (1.0f / least_turn)) +
                   node_square_root(square) * (1.0f / radius);
    return NODE(1.0f) / VMAX(share, NODE(LEAST_ERROR_SHARE)) - NODE(1.0f);
}

/// Weights of a record for a row of pixels; 0 where it does not serve.
static inline NFloat row_weights(const RenderParams* params, const SurfaceRow* row,
                                 const CacheRecord* record) {
    float radius = record->position.w;
    NFloat x = row->x - record->position.x;
    NFloat y = row->y - record->position.y;
    NFloat z = row->z - record->position.z;
    NFloat square = x * x + y * y + z * z;
    NFloat cosine = row->shading_x * record->normal.x + row->shading_y * record->normal.y +
                    row->shading_z * record->normal.z;
    NFloat turned = NODE(1.0f) - cosine;
    NFloat weight = NODE(1.0f) - square * (1.0f / (radius * radius)) -
                    turned * (1.0f / m_max(params->sampling.record_error, LEAST_TURN));
    if (HAS(params, FEATURE_HEMISPHERES)) weight = ward_weights(params, radius, square, turned);
    NFloat front = x * (row->normal_x + record->normal.x) + y * (row->normal_y + record->normal.y) +
                   z * (row->normal_z + record->normal.z);
    NFloat zero = NODE(0.0f);
    weight = SELECT(front > NODE(-2.0f * BEHIND_SHARE * radius), weight, zero);
    return VMAX(weight, zero);
}

// Clearance of a record by sector, and the axes that sectors are counted from.
typedef struct {
    float3 tangent, bitangent;
    float clear[CACHE_SECTORS];  // see CacheRecord
    float least;                 // of them
} RecordSectors;

static inline RecordSectors sectors_of(const CacheRecord* record) {
    RecordSectors sectors;
    make_basis(xyz(record->normal), &sectors.tangent, &sectors.bitangent);
    sectors.clear[0] = record->clear_low.x;
    sectors.clear[1] = record->clear_low.y;
    sectors.clear[2] = record->clear_low.z;
    sectors.clear[3] = record->clear_low.w;
    sectors.clear[4] = record->clear_high.x;
    sectors.clear[5] = record->clear_high.y;
    sectors.clear[6] = record->clear_high.z;
    sectors.clear[7] = record->clear_high.w;
    sectors.least = sectors.clear[0];
    for (uint i = 1u; i < CACHE_SECTORS; ++i)
        sectors.least = m_min(sectors.least, sectors.clear[i]);
    return sectors;
}

/// Pixels of a row that are beyond the record's clearance, so that something may hide them from it.
static inline NMask row_beyond_clearance(const SurfaceRow* row, const CacheRecord* record,
                                         const RecordSectors* sectors) {
    NFloat x = row->x - record->position.x;
    NFloat y = row->y - record->position.y;
    NFloat z = row->z - record->position.z;
    float3 t = sectors->tangent;
    float3 b = sectors->bitangent;
    NFloat u = x * t.x + y * t.y + z * t.z;
    NFloat v = x * b.x + y * b.y + z * b.z;
    NFloat up = x * record->normal.x + y * record->normal.y + z * record->normal.z;
    NFloat zero = NODE(0.0f);
    NMask right = u > zero;
    NMask above = v > zero;
    NMask flat = VMAX(u, -u) > VMAX(v, -v);
    const float* c = sectors->clear;
    NFloat first =
        SELECT(above, SELECT(flat, NODE(c[0]), NODE(c[1])), SELECT(flat, NODE(c[7]), NODE(c[6])));
    NFloat second =
        SELECT(above, SELECT(flat, NODE(c[3]), NODE(c[2])), SELECT(flat, NODE(c[4]), NODE(c[5])));
    NFloat clear = SELECT(right, first, second);
    // A pixel above or below the record rather than beside it belongs to no one sector.
    clear = SELECT(up * up > u * u + v * v, NODE(sectors->least), clear);
    return x * x + y * y + z * z > clear;
}

/// Sets weights to 0 where something lies between the record and a pixel.
static inline void weigh_seen(const RenderParams* params, Scene scene,
                              const TileFootprint* footprint, const CacheRecord* record,
                              float weights[TILE_EDGE][TILE_EDGE], uint* rays) {
    RecordSectors sectors = sectors_of(record);
    uint pixels[TILE_EDGE * TILE_EDGE];
    uint count = 0u;
    for (uint y = 0u; y < (uint)TILE_EDGE; ++y) {
        SurfaceRow row = surface_row(footprint, y);
        uint bits = node_mask_bits((node_load(weights[y]) > NODE(0.0f)) &
                                   row_beyond_clearance(&row, record, &sectors));
        for (uint x = 0u; x < (uint)TILE_EDGE; ++x)
            if ((bits >> x & 1u) != 0u) pixels[count++] = y * TILE_EDGE + x;
    }
    float3 from = xyz(record->origin);
    for (uint first = 0u; first < count; first += (uint)LANES) {
        LaneVectors ways;
        uint wanted = 0u;
        for (uint lane = 0u; lane < (uint)LANES; ++lane) {
            float3 way = f3(0.0f, 0.0f, 0.0f);
            if (first + lane < count) {
                uint y = pixels[first + lane] / TILE_EDGE;
                uint x = pixels[first + lane] % TILE_EDGE;
                float3 p = f3(footprint->position[0][y + 1u][x + 1u],
                              footprint->position[1][y + 1u][x + 1u],
                              footprint->position[2][y + 1u][x + 1u]);
                float3 n = f3(footprint->normal[0][y][x], footprint->normal[1][y][x],
                              footprint->normal[2][y][x]);
                way = p + n * surface_offset(p, params->scene.extent) - from;
                if (max_component(absolute3(way)) > 0.0f) wanted |= 1u << lane;
            }
            set_lane(&ways, lane, way);
        }
        if (wanted == 0u) continue;
        *rays += bit_count(wanted);
        uint blocked = mask_bits(trace_any_packet(scene, from, wide_of(&ways), mask_of(wanted)));
        for (uint lane = 0u; lane < (uint)LANES && first + lane < count; ++lane)
            if (((blocked & wanted) >> lane & 1u) != 0u)
                weights[pixels[first + lane] / TILE_EDGE][pixels[first + lane] % TILE_EDGE] = 0.0f;
    }
}

/// One channel of a record's irradiance at a row of pixels: `apart` are the pixels' places less its
/// own, `turned` is n x n'.
static inline NFloat row_channel(float light, float4 move, float4 turn, const NFloat* apart,
                                 const NFloat* turned) {
    NFloat value = NODE(light) + apart[0] * move.x + apart[1] * move.y + apart[2] * move.z +
                   turned[0] * turn.x + turned[1] * turn.y + turned[2] * turn.z;
    return VMAX(value, NODE(0.0f));
}

static inline void add_row(const SurfaceRow* row, const CacheRecord* record, NFloat weight, uint y,
                           CachedTile* tile) {
    float4 n = record->normal;
    NFloat apart[3];
    apart[0] = row->x - record->position.x;
    apart[1] = row->y - record->position.y;
    apart[2] = row->z - record->position.z;
    NFloat turned[3];
    turned[0] = row->shading_z * n.y - row->shading_y * n.z;
    turned[1] = row->shading_x * n.z - row->shading_z * n.x;
    turned[2] = row->shading_y * n.x - row->shading_x * n.y;
    NFloat red =
        row_channel(record->irradiance.x, record->move_red, record->turn_red, apart, turned);
    NFloat green =
        row_channel(record->irradiance.y, record->move_green, record->turn_green, apart, turned);
    NFloat blue =
        row_channel(record->irradiance.z, record->move_blue, record->turn_blue, apart, turned);
    node_store(node_load(tile->red[y]) + red * weight, tile->red[y]);
    node_store(node_load(tile->green[y]) + green * weight, tile->green[y]);
    node_store(node_load(tile->blue[y]) + blue * weight, tile->blue[y]);
    node_store(node_load(tile->weight[y]) + weight, tile->weight[y]);
}

/// Adds a record to the sums of the pixels that it serves; returns 0 where it serves none.
static inline int add_record(const RenderParams* params, Scene scene, const CacheRecord* record,
                             CachedTile* tile, uint* rays) {
    float weights[TILE_EDGE][TILE_EDGE];
    uint any = 0u;
    for (uint y = 0u; y < (uint)TILE_EDGE; ++y) {
        SurfaceRow row = surface_row(&tile->footprint, y);
        NFloat weight = row_weights(params, &row, record);
        // Pixels that are not lit have the normal 0, by which they may seem to lie in front.
        NFloat normal = row.shading_x * row.shading_x + row.shading_y * row.shading_y +
                        row.shading_z * row.shading_z;
        weight = SELECT(normal > NODE(0.0f), weight, NODE(0.0f));
        any |= node_mask_bits(weight > NODE(0.0f)) != 0u ? 1u << y : 0u;
        node_store(weight, weights[y]);
    }
    if (any == 0u) return 0;
    if (!HAS(params, FEATURE_HEMISPHERES) && record->normal.w > 0.0f)
        weigh_seen(params, scene, &tile->footprint, record, weights, rays);
    for (uint y = 0u; y < (uint)TILE_EDGE; ++y) {
        if ((any >> y & 1u) == 0u) continue;
        SurfaceRow row = surface_row(&tile->footprint, y);
        add_row(&row, record, node_load(weights[y]), y, tile);
    }
    return 1;
}

/// What earlier launches have found for the tile.
static inline void load_sums(const RenderParams* params, GLOBAL const float4* filtered, uint left,
                             uint top, CachedTile* tile) {
    for (uint y = 0u; y < (uint)TILE_EDGE; ++y) {
        for (uint x = 0u; x < (uint)TILE_EDGE; ++x) {
            float4 mean = f4(0.0f, 0.0f, 0.0f, 0.0f);
            if (left + x < params->camera.width && top + y < params->camera.height)
                mean = filtered[(top + y) * params->camera.width + left + x];
            tile->red[y][x] = mean.x * mean.w;
            tile->green[y][x] = mean.y * mean.w;
            tile->blue[y][x] = mean.z * mean.w;
            tile->weight[y][x] = mean.w;
        }
    }
}

static inline void store_means_of(const RenderParams* params, const CachedTile* tile, uint left,
                                  uint top, GLOBAL float4* filtered, uint* lacks) {
    for (uint bit = 0u; bit < (uint)(TILE_EDGE * TILE_EDGE); ++bit) {
        uint y = bit / TILE_EDGE;
        uint x = bit % TILE_EDGE;
        if (left + x >= params->camera.width || top + y >= params->camera.height) continue;
        float weight = tile->weight[y][x];
        float share = weight > 0.0f ? 1.0f / weight : 0.0f;
        filtered[(top + y) * params->camera.width + left + x] = f4(
            tile->red[y][x] * share, tile->green[y][x] * share, tile->blue[y][x] * share, weight);
        if (weight > ENOUGH_WEIGHT) lacks[bit / 32u] &= ~(1u << (bit % 32u));
    }
}

WEFT_KERNEL(cache_lookup)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint number = range.first + WORK_ITEM(range);
    uint columns = tile_columns(&params);
    uint left = number % columns * TILE_EDGE;
    uint top = number / columns * TILE_EDGE;
    SCENE_MAKE(scene);
    TileBox box;
    box.lower = xyz(tile_boxes[2u * number]);
    box.upper = xyz(tile_boxes[2u * number + 1u]);
    CachedTile tile;
    tile.loaded = 0;
    uint rays = 0u;
    uint count = record_count;
    uint groups = (count + CACHE_GROUP - 1u) / CACHE_GROUP;
    uint supers = (groups + CACHE_GROUP - 1u) / CACHE_GROUP;
    for (uint super = 0u; super < supers; ++super) {
        if (boxes_meet(&box, boxes[2u * super], boxes[2u * super + 1u]) == 0) continue;
        uint last = super * CACHE_GROUP + CACHE_GROUP;
        if (last > groups) last = groups;
        for (uint group = super * CACHE_GROUP; group < last; ++group) {
            GLOBAL const float4* bounds = boxes + 2u * (supers + group);
            if (boxes_meet(&box, bounds[0], bounds[1]) == 0) continue;
            uint end = group * CACHE_GROUP + CACHE_GROUP;
            if (end > count) end = count;
            for (uint i = group * CACHE_GROUP; i < end; ++i) {
                if (record_meets(&box, records[i].position) == 0) continue;
                if (tile.loaded == 0) {
                    load_footprint(&params, gb_ids, gb_albedo, gb_position, gb_normal, gb_shading,
                                   (int)left, (int)top, 0, &tile.footprint);
                    load_sums(&params, filtered, left, top, &tile);
                    tile.loaded = 1;
                }
                CacheRecord record = records[i];
                if (add_record(&params, scene, &record, &tile, &rays) != 0 &&
                    HAS(&params, FEATURE_TEMPORAL))
                    used[i] = 1u;
            }
        }
    }
    if (tile.loaded == 0) return;
    uint lacks[2] = {missing[2u * number], missing[2u * number + 1u]};
    store_means_of(&params, &tile, left, top, filtered, lacks);
    missing[2u * number] = lacks[0];
    missing[2u * number + 1u] = lacks[1];
    count_rays(counters + range.counter, rays);
}
