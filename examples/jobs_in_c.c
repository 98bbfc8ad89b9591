/* The host's own job system, in C90 with POSIX threads: bodice starts no thread, and hands its tasks to the host's.
 *
 *    bodice: enqueue(task) ---> [ queue of the host ] ---> host's threads: run(task)
 *  finish(handle) <---------- done ------------' a task that has not begun is run by finish() itself
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <bodice.h>

enum { PARTICLES = 20000, THREADS = 3, WAITING = 0, RUNNING = 1, DONE = 2 };

typedef struct job {
  void (*run)(void*);
  void* task;
  int state;
  struct job* next;
} job;

typedef struct job_system {
  pthread_mutex_t mutex;
  pthread_cond_t changed;
  job* first;
  int ends;
  unsigned handed, by_threads;
} job_system;

/* Runs a waiting job; the mutex is held before and after. */
static void perform(job_system* jobs, job* one) {
  one->state = RUNNING;
  pthread_mutex_unlock(&jobs->mutex);
  one->run(one->task);
  pthread_mutex_lock(&jobs->mutex);
  one->state = DONE;
  pthread_cond_broadcast(&jobs->changed);
}

static void* work(void* host) {
  job_system* jobs = host;
  pthread_mutex_lock(&jobs->mutex);
  while (!jobs->ends) {
    job* one = jobs->first;
    while (one && one->state != WAITING) one = one->next;
    if (one) {
      ++jobs->by_threads;
      perform(jobs, one);
    } else {
      pthread_cond_wait(&jobs->changed, &jobs->mutex);
    }
  }
  pthread_mutex_unlock(&jobs->mutex);
  return NULL;
}

static void* enqueue(void* host, const char* name, void (*run)(void*), void* task) {
  job_system* jobs = host;
  job* one = calloc(1, sizeof *one);
  (void)name; /* for a profiler */
  one->run = run;
  one->task = task;
  pthread_mutex_lock(&jobs->mutex);
  ++jobs->handed;
  one->next = jobs->first;
  jobs->first = one;
  pthread_cond_broadcast(&jobs->changed);
  pthread_mutex_unlock(&jobs->mutex);
  return one;
}

static void finish(void* host, void* handle) {
  job_system* jobs = host;
  job *one = handle, **at;
  pthread_mutex_lock(&jobs->mutex);
  if (one->state == WAITING) perform(jobs, one);
  while (one->state != DONE) pthread_cond_wait(&jobs->changed, &jobs->mutex);
  for (at = &jobs->first; *at != one; at = &(*at)->next) continue;
  *at = one->next;
  pthread_mutex_unlock(&jobs->mutex);
  free(one);
}

static const char ball[] =
    "{\"format\": \"bodice-proxy\", \"version\": 2, \"tier\": \"solid\", \"metres_per_unit\": 1.0, \"up\": \"y\","
    " \"stature\": 1.7, \"margin\": 0.0, \"source_hash\": \"0000000000000000\", \"ellipsoids\": ["
    "  {\"part\": \"head\", \"center\": [0, 1.6, 0], \"radii\": [0.1, 0.1, 0.1],"
    "   \"axes\": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}],"
    " \"relief\": [], \"texels\": \"\"}";

/* Moves particles of a grid out of the ball; returns whether all calls went well. */
static int resolve_grid(const bodice_context_options* options, float* xyz) {
  bodice_context* context = NULL;
  bodice_proxy* proxy = NULL;
  bodice_collider* collider = NULL;
  bodice_particles particles = bodice_default_particles();
  int i, ok;
  for (i = 0; i < PARTICLES; ++i) {
    xyz[3 * i] = 0.2f * (i % 100) / 100.0f - 0.1f;
    xyz[3 * i + 1] = 1.5f + 0.2f * (i / 100) / 200.0f;
    xyz[3 * i + 2] = 0.02f;
  }
  particles.count = PARTICLES;
  particles.position.x = xyz;
  ok = bodice_context_create(options, &context) == BODICE_OK &&
       bodice_proxy_from_bytes(context, ball, strlen(ball), &proxy) == BODICE_OK &&
       bodice_collider_create(context, proxy, &collider) == BODICE_OK &&
       bodice_resolve(collider, &particles, NULL, NULL, NULL) == BODICE_OK;
  if (!ok) printf("%s\n", bodice_last_error());
  bodice_collider_destroy(collider);
  bodice_proxy_destroy(proxy);
  bodice_context_destroy(context); /* all tasks are finished then */
  return ok;
}

int main(void) {
  static float alone[3 * PARTICLES], together[3 * PARTICLES];
  static job_system jobs = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, NULL, 0, 0, 0};
  pthread_t threads[THREADS];
  bodice_context_options one = bodice_default_context_options(), many = one;
  int i, ok;
  many.host = &jobs;
  many.workers = THREADS + 1; /* the calling thread works, too */
  many.enqueue = enqueue;
  many.finish = finish;
  for (i = 0; i < THREADS; ++i) pthread_create(&threads[i], NULL, work, &jobs);
  ok = resolve_grid(&one, alone) && resolve_grid(&many, together);
  pthread_mutex_lock(&jobs.mutex);
  jobs.ends = 1;
  pthread_cond_broadcast(&jobs.changed);
  pthread_mutex_unlock(&jobs.mutex);
  for (i = 0; i < THREADS; ++i) pthread_join(threads[i], NULL);
  printf("%u tasks, of which the host's threads ran %u\n", jobs.handed, jobs.by_threads);
  return ok && jobs.handed > 0 && !jobs.first && memcmp(alone, together, sizeof alone) == 0 ? 0 : 1;
}
