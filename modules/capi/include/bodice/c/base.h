/* What every part of the C interface uses: versions, errors, heads of structures, contexts. Include bodice.h.
 */
#ifndef BODICE_C_BASE_H
#define BODICE_C_BASE_H

#include <stddef.h>
#include <stdint.h>

/** Version of this header: major, minor, patch in a byte each. */
#define BODICE_VERSION 0x000100
/** Number of the binary interface. A library takes programs that were compiled with the same number. */
#define BODICE_ABI 1

/* BODICE_STATIC: the library is linked into the program, and nothing of it leaves the program's own
 * libraries. */
#if defined(BODICE_STATIC)
#define BODICE_EXPORT
#elif defined(_WIN32) && defined(BODICE_BUILDS_LIBRARY)
#define BODICE_EXPORT __declspec(dllexport)
#elif defined(_WIN32)
#define BODICE_EXPORT __declspec(dllimport)
#elif defined(__GNUC__)
#define BODICE_EXPORT __attribute__((visibility("default")))
#else
#define BODICE_EXPORT
#endif

#define BODICE_STABLE BODICE_EXPORT
#if defined(BODICE_BUILDS_LIBRARY) && defined(BODICE_ONLY_STABLE)
#define BODICE_EXPERIMENTAL
#else
#define BODICE_EXPERIMENTAL BODICE_EXPORT
#endif

#if defined(__cplusplus)
#define BODICE_INLINE inline
#elif defined(__GNUC__)
#define BODICE_INLINE static __inline__ __attribute__((unused))
#elif defined(_MSC_VER)
#define BODICE_INLINE static __inline
#else
#define BODICE_INLINE static
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What became of a call: BODICE_OK or a reason. */
typedef int32_t bodice_status;
enum {
  BODICE_OK = 0,
  BODICE_INVALID_ARGUMENT = 1,  /**< a parameter is null, not finite or out of its range */
  BODICE_NOT_FOUND = 2,         /**< a file or name does not exist */
  BODICE_UNREADABLE = 3,        /**< bytes or a file that cannot be parsed */
  BODICE_UNUSABLE_GEOMETRY = 4, /**< the input parsed, but no usable result can be made of it */
  BODICE_CANCELED = 5,          /**< the host stopped the work */
  BODICE_WRITE_FAILED = 6,      /**< an output could not be written; nothing was left behind */
  BODICE_INTERNAL = 7,          /**< a broken invariant inside bodice: please report the sentence */
  BODICE_OUT_OF_MEMORY = 8,     /**< an allocation failed, by malloc or by the host's hook */
  BODICE_NOT_INITIALIZED = 9,   /**< a structure that was not filled by its bodice_default_...() */
  BODICE_VERSION_MISMATCH = 10  /**< header and library do not fit together */
};

/** The sentence of the last call on this thread that failed, with its remedy. Never null; empty before the
 * first failure. Valid until the next failure on this thread. Any thread, no cost. */
BODICE_STABLE const char* bodice_last_error(void);
/** The name of a status, such as "BODICE_UNREADABLE". Static. Any thread. */
BODICE_STABLE const char* bodice_status_name(bodice_status status);
/** BODICE_VERSION of the library. Any thread. */
BODICE_STABLE uint32_t bodice_version(void);
/** One line about the build of the library: version, ABI, compiler, options, instruction set in use. Static.
 */
BODICE_STABLE const char* bodice_build(void);

/** Begins every structure that may grow. bodice_default_...() fills it; do not change it. */
typedef struct bodice_head {
  uint32_t struct_size; /**< size of the structure as the program was compiled */
  uint32_t cookie;      /**< shows that the structure has its defaults */
} bodice_head;

/** Kinds of structures with a head, for bodice_fill_defaults(). */
enum {
  BODICE_CONTEXT_OPTIONS = 1,
  BODICE_PROXY_INFO = 2,
  BODICE_POSE = 3,
  BODICE_PARTICLES = 4,
  BODICE_CONTACTS = 5,
  BODICE_QUERY_OPTIONS = 6,
  BODICE_RESOLVE_OPTIONS = 7,
  BODICE_CONTACT_REPORT = 8,
  BODICE_MESH = 9,
  BODICE_RIG = 10,
  BODICE_SKIN_OPTIONS = 11,
  BODICE_SKIN_INFO = 12,
  BODICE_FIT_OPTIONS = 13,
  BODICE_FIT_REPORT = 14,
  BODICE_GARMENT = 15,
  BODICE_SESSION_OPTIONS = 16,
  BODICE_STEP_REPORT = 17,
  BODICE_DRAPE_OPTIONS = 18,
  BODICE_DRAPE_REPORT = 19
};

/** Fills a structure of `size` bytes with its defaults and its head. The functions bodice_default_...() below
 * call it; languages without them may do so, too. Fails with BODICE_VERSION_MISMATCH for an unknown kind. Any
 * thread. */
BODICE_STABLE bodice_status bodice_fill_defaults(int32_t kind, void* structure, size_t size);

/** Levels of log messages. */
enum { BODICE_DEBUG = 0, BODICE_INFO = 1, BODICE_WARNING = 2, BODICE_ERROR = 3 };

/** Where the work of a context runs and what it uses of the host. All hooks are optional, get `host` back,
 * may be called from any thread that works for the context, and must work until the last handle of the
 * context is gone. */
typedef struct bodice_context_options {
  bodice_head head;
  uint32_t abi; /**< BODICE_ABI of the program; filled by the defaults */
  int32_t
      workers; /**< threads that work on a call, the caller's included; 0: one a hardware thread; default 1 */
  void* host;  /**< passed to the hooks */
  int32_t log_level; /**< least level that is logged; default BODICE_INFO */
  int32_t reserved;
  /** Receives one line, ended by a zero and without a newline. Calls never overlap. */
  void (*log)(void* host, int32_t level, const char* message);
  /** Memory for arrays that grow with particles or with texels: those of workspaces, and of colliders with
   * relief. Both or neither; null is a failure. May be called from any thread, several at a time. Smaller
   * blocks and proxies come from malloc and operator new. */
  void* (*allocate)(void* host, size_t bytes, size_t alignment);
  void (*release)(void* host, void* block, size_t bytes);
  /** Nanoseconds since any start, never falling; null: the monotonic clock of the machine. */
  int64_t (*now_ns)(void* host);
  /** The job system of the host, in place of threads of bodice's own: both functions or neither. `workers`
   * then bounds the jobs at a time, the calling thread included. enqueue() arranges for run(task) to be
   * called once, on any thread, now or later, and returns a handle that is not null. finish() returns when
   * that call is over, and releases the handle. No call of bodice waits for a task that has not begun. `name`
   * is static or lives as long as the task. */
  void* (*enqueue)(void* host, const char* name, void (*run)(void* task), void* task);
  void (*finish)(void* host, void* handle);
  int32_t
      tasks_in_flight; /**< bound on tasks of this context that are enqueued and not finished; default 64 */
  int32_t reserved2;
} bodice_context_options;

BODICE_INLINE bodice_context_options bodice_default_context_options(void) {
  bodice_context_options options;
  bodice_fill_defaults(BODICE_CONTEXT_OPTIONS, &options, sizeof options);
  options.abi = BODICE_ABI;
  return options;
}

/** The surroundings of all work: threads, log, memory, clock. Contexts do not know of each other. */
typedef struct bodice_context bodice_context;

/** Makes a context. Fails with BODICE_VERSION_MISMATCH, naming both sides, if the program was compiled with
 * another BODICE_ABI. Starts workers - 1 threads unless the host has a job system. Any thread. */
BODICE_STABLE bodice_status bodice_context_create(const bodice_context_options* options,
                                                  bodice_context** context);
/** Gives the context back; its threads end with the last handle that was made in it. */
BODICE_STABLE void bodice_context_destroy(bodice_context* context);

#ifdef __cplusplus
}
#endif

#endif
