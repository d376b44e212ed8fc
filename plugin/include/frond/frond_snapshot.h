/* frond_snapshot.h - a world as bytes, to go back to: roll-back networking, undo. Compiles as C99 and as C++; the rules
 * of frond.h for handles, errors and threads hold.
 *
 * A snapshot holds all that steps change: shape and motion of plants, their plastic strain, pins, targets of grabs,
 * which plants sleep, the time and the gusts that have passed, and the bodies that Frond made. It does not hold what
 * the host set up: defs, effects, gravity, wind, and the bodies of a Bullet world of its own, which it restores itself.
 * Saving and restoring both make Bullet search for contacts anew; from either, a world of Frond's own steps on to the
 * same bits. Plants stay where the host put them: after frond_plant_set_transform and frond_world_shift_origin save
 * anew. UNSUPPORTED with robots (frond_robot.h).
 */
#ifndef FROND_SNAPSHOT_H
#define FROND_SNAPSHOT_H

#include "frond/frond.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the size of a snapshot that frond_world_save writes now [bytes]; 0 for an invalid handle and for a world with
 * robots, which cannot be saved. */
FROND_API size_t frond_world_get_snapshot_size(frond_world world);
/* Saves the world into `snapshot`. size must be what frond_world_get_snapshot_size returns. */
FROND_API frond_result frond_world_save(frond_world world, void* snapshot, size_t size);
/* Restores a snapshot into a world with the same plants, grabs, bonds and rigid bodies in the order in which they were
 * made; plants of the same models and settings. What broke off since is its plant's own again, if nothing was made
 * after that; what had come off then has to have come off in the same order. Handles stay valid. Else BAD_ARGUMENT, and
 * FILE_FORMAT for bytes that are cut off, changed, or of another version or precision of Frond; nothing is changed. */
FROND_API frond_result frond_world_restore(frond_world world, const void* snapshot, size_t size);

#ifdef __cplusplus
}
#endif
#endif /* FROND_SNAPSHOT_H */
