/* Threads of the garden: a loop whose jobs are taken by whoever is free. */
#include "garden.h"

#ifdef __EMSCRIPTEN_PTHREADS__
#include <pthread.h>
#include <stdatomic.h>

static struct {
    pthread_mutex_t lock;
    pthread_cond_t begun;
    int count; /* of threads beside the caller's */
    int loops; /* begun so far; changes and what follows are read with the lock */
    frond_job_fn* job;
    void* data;
    int jobs;
    atomic_int next, running;
} pool = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0, 0, NULL, NULL, 0, 0, 0};

static void take_jobs(frond_job_fn* job, void* data, int jobs) {
    int i;
    while ((i = atomic_fetch_add(&pool.next, 1)) < jobs) job(data, i);
}

static void* work(void* unused) {
    int seen = 0;
    for (;;) {
        frond_job_fn* job;
        void* data;
        int jobs;
        pthread_mutex_lock(&pool.lock);
        while (pool.loops == seen) pthread_cond_wait(&pool.begun, &pool.lock);
        seen = pool.loops;
        job = pool.job, data = pool.data, jobs = pool.jobs;
        /* Nobody begins another loop while one runs. */
        if (jobs > 0) atomic_fetch_add(&pool.running, 1);
        pthread_mutex_unlock(&pool.lock);
        if (jobs == 0) continue;
        take_jobs(job, data, jobs);
        atomic_fetch_sub(&pool.running, 1);
    }
    return unused;
}

static void run(int count, frond_job_fn* job, void* data, void* unused) {
    (void)unused;
    pthread_mutex_lock(&pool.lock);
    pool.job = job, pool.data = data, pool.jobs = count;
    atomic_store(&pool.next, 0);
    pool.loops++;
    pthread_cond_broadcast(&pool.begun);
    pthread_mutex_unlock(&pool.lock);
    take_jobs(job, data, count);
    /* Who wakes late finds no jobs. A page's own thread may not sleep, so it waits awake. */
    pthread_mutex_lock(&pool.lock);
    pool.jobs = 0;
    pthread_mutex_unlock(&pool.lock);
    while (atomic_load(&pool.running) > 0) {
    }
}

frond_parallel_for_fn* garden_threads(int count) {
    for (; pool.count < count - 1; pool.count++) {
        pthread_t thread;
        if (pthread_create(&thread, NULL, work, NULL) != 0) break;
        pthread_detach(thread);
    }
    return pool.count > 0 ? run : NULL;
}
#else
frond_parallel_for_fn* garden_threads(int count) {
    (void)count;
    return NULL;
}
#endif
