/* frond_robot.h - robots among plants: arms and grippers described in URDF files become multi-bodies of the Bullet
 * world, with motors, and feel the plants that they push. Compiles as C99 and as C++; the rules of frond.h hold here
 * too.
 *
 * A robot is a tree of links; link 0 is its base, and every other link hangs on its parent by one joint, which has the
 * link's number. Joints are fixed, revolute, continuous, prismatic or, between the base and the rest, floating. The
 * file's <inertial>, <collision> and <joint> with its <limit> count; <visual>, <mimic>, <dynamics> and <safety> do not.
 * Meshes collide as their convex hulls. A mesh that the file calls "package://NAME/PATH" is searched for in the folders
 * of the environment variables FROND_PACKAGE_PATH and ROS_PACKAGE_PATH (separated by colons), then in those above the
 * file.
 *
 * Motors and limits are held as well as Bullet's solver converges: in a world of frond_world_create it makes 100
 * iterations once there is a robot; in your own, set getSolverInfo().m_numIterations (with Bullet's default of 10 an
 * arm sags by a degree).
 *
 * Plants push links as they push any body; their force on a link in a substep is the sum over its contacts. Robots do
 * not collide with themselves. */
#ifndef FROND_ROBOT_H
#define FROND_ROBOT_H

#include "frond/frond.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct frond_robot {
    uint64_t id;
} frond_robot;

#define FROND_JOINTS(X)                                        \
    X(FIXED, "fixed")           /* also of link 0 */           \
    X(REVOLUTE, "revolute")     /* turns between two limits */ \
    X(CONTINUOUS, "continuous") /* turns without limits */     \
    X(PRISMATIC, "prismatic")   /* slides between two limits */
#define FROND_JOINT_ENUM(code, text) FROND_JOINT_##code,
typedef enum frond_joint { FROND_JOINTS(FROND_JOINT_ENUM) FROND_JOINT_COUNT } frond_joint;
#undef FROND_JOINT_ENUM
/* Returns the short lower-case name of a joint, "revolute"; "?" when it is out of range. */
FROND_API const char* frond_joint_name(frond_joint joint);

typedef struct frond_robot_def {
    uint32_t cookie;     /* do not set */
    frond_vec3 position; /* position of the base [m], default the origin */
    frond_quat rotation; /* rotation of the base; default: the file's up axis, +z, is +y */
    bool is_fixed;       /* the base does not move, default true; false for a base that hangs on a floating joint */
    double friction;     /* friction of all links, default 0.5; Bullet multiplies it by the other body's or organ's */
    int group, mask;     /* Bullet's collision filter, default 1 and -1 */
} frond_robot_def;

/* The properties of a link that do not change. Strings are borrowed; they live as long as the robot. */
typedef struct frond_robot_link {
    const char* name;
    const char* joint_name; /* "" for link 0 */
    int parent;             /* -1 for link 0 */
    frond_joint joint;
    double lower, upper; /* limits of the joint [rad], [m]; 0 where it has none */
    double max_force;    /* limit of its motor in the file [N], [N m]; 0: none given */
    double mass;         /* [kg] */
    const void* body;    /* the body as in frond_contact.body; null: it touches nothing */
} frond_robot_link;

/* The present state of a link, in the world's frame. */
typedef struct frond_link_state {
    frond_vec3 position; /* origin of the link's frame, where its joint is [m] */
    frond_quat rotation;
    frond_vec3 force;                      /* force of all plants on the link in the last substep [N] */
    frond_vec3 torque;                     /* their torque about the link's centre of mass [N m] */
    int contact_count;                     /* number of points at which they touch it */
    double joint_position, joint_velocity; /* [rad], [m]; [rad/s], [m/s] */
    double motor_force;                    /* force of the joint's motor in the last substep [N m], [N] */
} frond_link_state;

/* Returns the default settings of a robot. */
static inline frond_robot_def frond_default_robot_def(void) {
    frond_robot_def def;
    frond_fill_def(&def, FROND_DEF_COOKIE('U'));
    return def;
}
/* Loads a robot from a URDF file, read in a process of its own, as frond_model_load does. FILE_FORMAT for a file that
 * is damaged, cyclic or huge, FILE_NOT_FOUND for a mesh that is missing, UNSUPPORTED for a floating joint in the middle
 * of the tree or a Bullet world that takes no multi-bodies: a btMultiBodyDynamicsWorld does, and the worlds of
 * frond_world_create are such. All joints begin at zero or at the limit nearest to it, held there by their motors. */
FROND_API frond_result frond_robot_load(frond_world world, const char* path, const frond_robot_def* def,
                                        frond_robot* out);
/* Destroys a robot. Null and stale handles are ignored. It is destroyed with its world, too. */
FROND_API void frond_robot_destroy(frond_robot robot);
/* Returns whether a handle is of a robot that exists. */
FROND_API bool frond_robot_is_valid(frond_robot robot);
/* Returns the number of links; 0 for an invalid handle. */
FROND_API int frond_robot_get_link_count(frond_robot robot);
/* Returns the number of the link that has this name or whose joint has it; -1 if there is none or the handle is
 * invalid. */
FROND_API int frond_robot_find_link(frond_robot robot, const char* name);
/* Describes the properties of a link that do not change. */
FROND_API frond_result frond_robot_get_link(frond_robot robot, int link, frond_robot_link* out);
/* Gives the state of a link after the last substep, with the force of plants on it. */
FROND_API frond_result frond_robot_get_link_state(frond_robot robot, int link, frond_link_state* out);
/* Gives the collision shapes of all links as triangles in the world's frame: meshes as they are in their files.
 * Normals, uvs and colors are null. Borrowed until the next call or destroy. */
FROND_API frond_result frond_robot_get_surface(frond_robot robot, frond_surface_view* out);
/* Puts a joint there at once, at rest, and has its motor hold it. BAD_ARGUMENT for fixed joints, and beyond limits. */
FROND_API frond_result frond_robot_set_joint(frond_robot robot, int link, double position);
/* Drives a joint: its motor goes to `position` [rad], [m], no faster than max_velocity [rad/s], [m/s] (0: the file's
 * limit, or 1 where it has none), with up to max_force [N m], [N]; 0: the file's limit, or 1000 where it has none. */
FROND_API frond_result frond_robot_drive_to(frond_robot robot, int link, double position, double max_velocity,
                                            double max_force);
/* Drives a joint at a velocity [rad/s], [m/s], which its motor keeps; max_force as above. */
FROND_API frond_result frond_robot_drive_at(frond_robot robot, int link, double velocity, double max_force);
/* Lets a joint move freely until it is driven again. */
FROND_API frond_result frond_robot_release(frond_robot robot, int link);
/* Makes a bond as frond_bond_create does, to a link: what a gripper holds. */
FROND_API frond_result frond_robot_bond(frond_plant plant, frond_vec3 point, frond_robot robot, int link,
                                        frond_bond* out);

/* Writes a model's chain as a URDF file that other programs read: a link with a <visual>, a <collision> and an
 * <inertial> for each capsule, hung on each other by fixed joints, +z up, and in <frond> what Frond needs to make the
 * same plant of it again: organ, material, and the stiffness and mass of the section, so that all links together weigh
 * what the plant does. Materials are written by kind, so that the caller's own count only by the stiffness that they
 * gave the sections. FILE_NOT_FOUND if the file cannot be written. */
FROND_API frond_result frond_model_write_urdf(frond_model model, const char* path);

/* Computes the force that holds a plant, of the ground on its pinned nodes, in the world's frame [N], and its moment
 * about `about` [N m]. Either may be null. It is what weight, elastic and damping forces after the last substep leave to
 * be held, and what pins that move take to be accelerated: for a plant at rest, and for one that is carried evenly, the
 * opposite of its weight and of all loads beyond its foot. */
FROND_API frond_result frond_plant_get_root_force(frond_plant plant, frond_vec3 about, frond_vec3* force,
                                                  frond_vec3* moment);

#ifdef __cplusplus
}
#endif
#endif /* FROND_ROBOT_H */
