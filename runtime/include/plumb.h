/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The C interface, for embedding Plumb in an existing controller. C99 and later, or C++.
 *
 * Life of a robot:   plumb_load_*  ->  plumb_correct once in every cycle  ->  plumb_unload
 *                    plumb_configure before the first cycle, to change the default limits
 *                    plumb_swap_* from a loader thread, whenever a better model exists
 *
 * | phase | calls                                                | heap | thread                  |
 * |-------|------------------------------------------------------|------|-------------------------|
 * | load  | plumb_load_*, plumb_configure, plumb_unload          | yes  | any, nothing else runs  |
 * | swap  | plumb_swap_*, plumb_collect                          | yes  | one loader thread       |
 * | cycle | plumb_correct, plumb_enable, plumb_predict,          | no   | one cycle thread        |
 * |       | plumb_read_counters                                  |      |                         |
 * | rows  | plumb_predict_rows, plumb_correct_rows               | no   | any, while no other     |
 * |       |                                                      |      | loads or swaps          |
 * | any   | plumb_*_init and the calls that return text or the   | no   | any                     |
 * |       | number of joints                                     |      |                         |
 *
 * The loader thread and the cycle thread may run at the same time. Calls of the cycle take no lock,
 * allocate no memory and make no system call, and their cost is fixed for a given model.
 *
 * Errors: no call crashes on a pointer that is null or misaligned, on a struct of another size, on
 * structs that overlap, or on any bit pattern in a number. It returns the error and changes nothing
 * else. Pointers to memory that is not yours, and robots that were unloaded, cannot be detected.
 *
 * Structs carry their size: set it to sizeof before the call (plumb_input_init does so). A library
 * that knows more members than your header neither reads nor writes beyond that size.
 *
 * Units: SI, [rad] or [m] for joints, temperatures in degrees Celsius, times as the suffix says.
 * Poses are those of the tool in the robot's base frame. R is stored row by row; its columns are
 * the axes of the tool.
 */
#ifndef PLUMB_H
#define PLUMB_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the shared library exports; nothing for who calls it. */
#if defined(_WIN32) && defined(PLUMB_BUILDS_DLL)
#define PLUMB_API __declspec(dllexport)
#elif defined(PLUMB_BUILDS_DLL)
#define PLUMB_API __attribute__((visibility("default")))
#else
#define PLUMB_API
#endif

#define PLUMB_MAX_JOINTS 9
#define PLUMB_MAX_TEMPERATURES 8

/* The result of a call. */
typedef enum plumb_result {
  PLUMB_OK = 0,
  PLUMB_NULL = 1,           /* a pointer is null that must not be */
  PLUMB_MISALIGNED = 2,     /* a pointer is not aligned for its struct */
  PLUMB_BAD_SIZE = 3,       /* a struct's size is smaller than any version of it */
  PLUMB_NOT_A_ROBOT = 4,    /* the pointer does not come from plumb_load_* */
  PLUMB_UNREADABLE = 5,     /* no such file, damaged, not a model, or its content makes no sense */
  PLUMB_UNKNOWN_EFFECT = 6, /* the model needs an effect that this version does not have */
  PLUMB_OTHER_ROBOT = 7,    /* the model was made for another robot */
  PLUMB_BUSY = 8,           /* the cycle has not taken the last model yet: try again later */
  PLUMB_NO_MEMORY = 9,
  PLUMB_BAD_NUMBER = 10, /* a setting is negative, infinite or NaN */
  PLUMB_RUNNING = 11     /* too late: the robot's cycle has begun */
} plumb_result;

/* The status of a cycle. 0: ok. > 0: valid, but degraded. < 0: refused, the correction decays to 0.
 */
typedef enum plumb_status {
  PLUMB_STATUS_OK = 0,
  PLUMB_STATUS_OUTSIDE_DOMAIN = 1,   /* outside the trained joints or context: correction fades */
  PLUMB_STATUS_CONTEXT_FALLBACK = 2, /* an input of an effect was missing or stale */
  PLUMB_STATUS_LIMITED = 3,          /* the correction was cut to its size or slew limit */
  PLUMB_STATUS_RAMPING = 4,          /* the correction is being ramped in or out */
  PLUMB_STATUS_PARTIAL = 5,          /* near a singular pose: a part of the error is corrected */
  PLUMB_STATUS_NOT_FINITE = -1,      /* a target or joint position is not finite or not valid */
  PLUMB_STATUS_NEAR_SINGULAR = -2,
  PLUMB_STATUS_OTHER_CONFIGURATION = -3,
  PLUMB_STATUS_FAR_FROM_SEED = -4,
  PLUMB_STATUS_NOT_CONVERGED = -5,
  PLUMB_STATUS_SEED_NOT_COMMANDED = -6, /* more than six joints need q_commanded */
  PLUMB_STATUS_NO_MODEL = -7,
  PLUMB_STATUS_STALE = -8 /* no fresh target or joint state within the limits, 0.1 s by default */
} plumb_status;

/* One robot: its model and the state of its cycle. */
typedef struct plumb_robot plumb_robot;

typedef struct plumb_pose {
  double p_m[3];
  double R[9];
} plumb_pose;

/* A value and how long ago it was taken [s]. */
typedef struct plumb_reading {
  double value;
  double age_s;
} plumb_reading;

/* Bits of plumb_input.arrived. Members that did not arrive are not read; the previous values stay
   in use and grow older. */
#define PLUMB_TARGET UINT32_C(1)                    /* X_BD */
#define PLUMB_MEASURED UINT32_C(2)                  /* q_measured */
#define PLUMB_COMMANDED UINT32_C(4)                 /* q_commanded; seven joints or more need it */
#define PLUMB_PAYLOAD UINT32_C(8)                   /* payload_kg, payload_com_m */
#define PLUMB_TIME UINT32_C(16)                     /* time_s */
#define PLUMB_TEMPERATURE(k) (UINT32_C(256) << (k)) /* temperature_degC[k], k = 0 .. 7 */

typedef struct plumb_input {
  uint32_t size;    /* sizeof(plumb_input) */
  uint32_t arrived; /* bits above */
  int64_t now_ns;   /* time on any clock that advances; jumps do no harm */
  plumb_pose X_BD;  /* desired tool pose */
  double q_measured[PLUMB_MAX_JOINTS];
  double q_commanded[PLUMB_MAX_JOINTS]; /* joint positions that the controller commands for X_BD */
  plumb_reading payload_kg;
  double payload_com_m[3];                                /* flange frame */
  plumb_reading temperature_degC[PLUMB_MAX_TEMPERATURES]; /* order: plumb_temperature_name */
  plumb_reading time_s; /* process time, as in the measurements; it runs on between readings */
} plumb_input;

typedef struct plumb_output {
  uint32_t size;              /* sizeof(plumb_output) */
  int32_t has_output;         /* 0 until the first valid cycle; nothing may be sent before */
  int32_t status;             /* plumb_status of the output */
  int32_t solved;             /* plumb_status of the inverse alone, before limits and ramps */
  plumb_pose X_BC;            /* pose to send; always finite, R is always a rotation */
  double q[PLUMB_MAX_JOINTS]; /* joint positions that bring the true arm to X_BD */
  double residual_m;          /* position error that the inverse left */
  double residual_rad;        /* orientation error that the inverse left */
} plumb_output;

typedef struct plumb_joints {
  uint32_t size;     /* sizeof(plumb_joints) */
  uint32_t reserved; /* 0 */
  double q[PLUMB_MAX_JOINTS];
} plumb_joints;

typedef struct plumb_prediction {
  uint32_t size;    /* sizeof(plumb_prediction) */
  int32_t status;   /* plumb_status */
  plumb_pose X_BT;  /* predicted true pose of the tool; the identity if refused */
  double tree_m[3]; /* part of the position that comes from the tree */
} plumb_prediction;

/* Poses to predict or to correct, row by row. Arrays hold `count` rows, one after the other. Of
   what is known beside the joints, an array may be null and any number NaN: unknown. */
typedef struct plumb_rows {
  uint32_t size;                  /* sizeof(plumb_rows) */
  uint32_t seed;                  /* what q is to plumb_correct_rows: PLUMB_MEASURED, or
                                     PLUMB_COMMANDED, which seven joints or more need */
  uint64_t count;                 /* number of rows */
  const double* q;                /* joint positions, plumb_joint_count a row */
  const double* payload_kg;       /* one a row */
  const double* payload_com_m;    /* three a row, flange frame; not read without payload_kg */
  const double* temperature_degC; /* one a row for every plumb_temperature_name */
  const double* time_s;           /* one a row: process time */
  const double* direction;        /* of each joint's last move: -1, 0 or 1 */
  const double* travel;           /* size of that move, [rad] or [m] */
} plumb_rows;

/* How long the cycle may use its last inputs [s], and when a joint counts as moved. */
typedef struct plumb_settings {
  uint32_t size;              /* sizeof(plumb_settings) */
  uint32_t reserved;          /* 0 */
  double target_limit_s;      /* if older, the correction ramps out as stale; default 0.1 */
  double joints_limit_s;      /* likewise; default 0.1 */
  double payload_limit_s;     /* if older, effects use their fallback; default: no limit */
  double temperature_limit_s; /* likewise; default 60 */
  double time_limit_s;        /* likewise; default 60 */
  double dead_band_rad;       /* a joint that moves back by less has not reversed; default 5e-4; for
                                 prismatic joints it is multiplied by the model's length scale */
} plumb_settings;

/* Counters that only grow, from loading on. A cycle counts as at most one of held, stale, refused
   and limited: the first that applies. */
typedef struct plumb_counters {
  uint32_t size;     /* sizeof(plumb_counters) */
  uint32_t reserved; /* 0 */
  uint64_t steps;
  uint64_t refused;
  uint64_t limited;
  uint64_t held;
  uint64_t stale;
  uint64_t swaps;
} plumb_counters;

/* ---- load: slow, uses the heap and, by file, the disk ---- */

/*
 * Reads, verifies and binds a model. serial: the robot it must be made for; null takes any.
 * *robot: the loaded robot, or null after an error. message: one sentence about an error, ended by
 * a 0 within `capacity` bytes; may be null.
 * Returns OK, NULL, MISALIGNED, UNREADABLE, UNKNOWN_EFFECT, OTHER_ROBOT, NO_MEMORY.
 */
PLUMB_API plumb_result plumb_load_file(const char* path, const char* serial, plumb_robot** robot,
                                       char* message, size_t capacity);
/* The same from memory of any alignment, which may be freed afterwards. */
PLUMB_API plumb_result plumb_load_bytes(const void* bytes, size_t count, const char* serial,
                                        plumb_robot** robot, char* message, size_t capacity);

/* Fills in the settings that every robot is loaded with, and the size. OK, NULL, MISALIGNED. */
PLUMB_API plumb_result plumb_settings_init(plumb_settings* settings);

/*
 * Changes the settings before the first cycle; they remain when models are swapped. After an error
 * nothing has changed. OK, NULL, MISALIGNED, BAD_SIZE, NOT_A_ROBOT, BAD_NUMBER, RUNNING.
 */
PLUMB_API plumb_result plumb_configure(plumb_robot* robot, const plumb_settings* settings);

/* Frees the robot; no thread may use it any more. Null is allowed. OK, MISALIGNED, NOT_A_ROBOT. */
PLUMB_API plumb_result plumb_unload(plumb_robot* robot);

/* ---- swap: slow, uses the heap; one loader thread beside the running cycle ---- */

/*
 * Reads and verifies another model of the same robot and hands it to the cycle, which takes it at
 * the beginning of its next step; the output moves to the new model at the slew limit, without a
 * jump. The same robot has the same serial, nominal chain, base and tool, and its sensors in the
 * same order. After an error the running model stays in use. Returns what plumb_load_file returns,
 * and also NOT_A_ROBOT and BUSY.
 */
PLUMB_API plumb_result plumb_swap_file(plumb_robot* robot, const char* path, char* message,
                                       size_t capacity);
PLUMB_API plumb_result plumb_swap_bytes(plumb_robot* robot, const void* bytes, size_t count,
                                        char* message, size_t capacity);

/*
 * Frees the previous model. Returns OK once the cycle has taken the last one, and BUSY until then.
 * It need not be called before another swap, which does the same first.
 */
PLUMB_API plumb_result plumb_collect(plumb_robot* robot);

/* ---- cycle: no heap, no lock, no system call; one thread ---- */

/* Sets the size, marks all inputs as not arrived and all numbers as unknown. OK, NULL, MISALIGNED.
 */
PLUMB_API plumb_result plumb_input_init(plumb_input* input);

/*
 * Steps the cycle once. `output` is written whenever it can be; after an error has_output is 0 and
 * the cycle did not step. Input and output may overlap: the input is read first.
 * OK, NULL, MISALIGNED, BAD_SIZE, NOT_A_ROBOT.
 */
PLUMB_API plumb_result plumb_correct(plumb_robot* robot, const plumb_input* input,
                                     plumb_output* output);

/* Ramps the correction out (on = 0) or in again. OK, NULL, MISALIGNED, NOT_A_ROBOT. */
PLUMB_API plumb_result plumb_enable(plumb_robot* robot, int on);

/* Predicts the tool's pose at q with the context of the last cycle. Errors as plumb_correct. */
PLUMB_API plumb_result plumb_predict(const plumb_robot* robot, const plumb_joints* joints,
                                     plumb_prediction* prediction);

/* Reads the counters. Errors as plumb_correct. */
PLUMB_API plumb_result plumb_read_counters(const plumb_robot* robot, plumb_counters* counters);

/* ---- rows: lists of poses, outside of the cycle; no heap, no lock; time grows with them ---- */

/*
 * Predicts where the tool truly is, with the model that was loaded or swapped in last. The cycle
 * and its state are not used. X_BT, status: one a row, as in plumb_prediction; the status may also
 * be OUTSIDE_DOMAIN, or LIMITED where the guard would cut a correction that large. OK, NULL,
 * MISALIGNED, BAD_SIZE, NOT_A_ROBOT; after an error nothing is written.
 */
PLUMB_API plumb_result plumb_predict_rows(const plumb_robot* robot, const plumb_rows* rows,
                                          plumb_pose* X_BT, int32_t* status);

/*
 * Corrects targets X_BD from the seeds rows->q: what plumb_correct comes to while a row stays as it
 * is, without ramp and slew limit. X_BC and X_BD may be the same array. q: the joint positions that
 * bring the true arm to the target, plumb_joint_count a row; may be null. Where a row is refused,
 * X_BC is the target (the identity if that is no pose) and q the seed. BAD_NUMBER: rows->seed is
 * neither of its two values. Other errors as plumb_predict_rows.
 */
PLUMB_API plumb_result plumb_correct_rows(const plumb_robot* robot, const plumb_rows* rows,
                                          const plumb_pose* X_BD, plumb_pose* X_BC, double* q,
                                          int32_t* status);

/* ---- any thread, constant ---- */

/* Number of joints; 0 if this is no robot. */
PLUMB_API int plumb_joint_count(const plumb_robot* robot);
/* Serial of the robot, from its first model; empty if it has none or this is no robot. */
PLUMB_API const char* plumb_serial(const plumb_robot* robot);
/* Name of sensor k of the first model; null after the last, or if this is no robot. */
PLUMB_API const char* plumb_temperature_name(const plumb_robot* robot, int k);
/* Lower-case text, for example "near-singular"; "unknown" for numbers that are no status. */
PLUMB_API const char* plumb_status_text(int32_t status);
/* Plain English, for example "made for another robot"; "unknown" for numbers that are no result. */
PLUMB_API const char* plumb_result_text(int32_t result);
/* Version of the library, for example "0.1.0". */
PLUMB_API const char* plumb_version(void);

#ifdef __cplusplus
}
#endif

#endif /* PLUMB_H */
