/* Threads (POSIX) where there is one. What would wait for another one is a fault: it waits for ever. */

#include <errno.h>
#include <pthread.h>

#include "host.h"

#undef pthread_create

int sched_yield(void) { return 0; }

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *given)
{
	return (void)thread, (void)attributes, (void)start, (void)given, EAGAIN;
}

int pthread_join(pthread_t thread, void **result) { return (void)thread, (void)result, ESRCH; }
int pthread_detach(pthread_t thread) { return (void)thread, ESRCH; }
int pthread_cancel(pthread_t thread) { return (void)thread, ESRCH; }
pthread_t pthread_self(void) { return 1; }
int pthread_equal(pthread_t a, pthread_t b) { return a == b; }

int pthread_once(pthread_once_t *done, void (*start)(void))
{
	if (!*done) {
		*done = 1;
		start();
	}
	return 0;
}

int pthread_attr_init(pthread_attr_t *attributes) { return *attributes = 0; }
int pthread_attr_destroy(pthread_attr_t *attributes) { return (void)attributes, 0; }
int pthread_attr_setdetachstate(pthread_attr_t *attributes, int state) { return *attributes = state, 0; }

int pthread_attr_setstacksize(pthread_attr_t *attributes, size_t size)
{
	return (void)attributes, (void)size, 0;
}

int pthread_mutexattr_init(pthread_mutexattr_t *attributes) { return *attributes = 0; }
int pthread_mutexattr_settype(pthread_mutexattr_t *attributes, int kind) { return *attributes = kind, 0; }
int pthread_mutexattr_destroy(pthread_mutexattr_t *attributes) { return (void)attributes, 0; }

int pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *attributes)
{
	mutex->locks = 0;
	mutex->kind = attributes ? *attributes : PTHREAD_MUTEX_DEFAULT;
	return 0;
}

int pthread_mutex_destroy(pthread_mutex_t *mutex) { return mutex->locks ? EBUSY : 0; }

int pthread_mutex_trylock(pthread_mutex_t *mutex)
{
	if (mutex->locks && mutex->kind != PTHREAD_MUTEX_RECURSIVE)
		return EBUSY;
	mutex->locks++;
	return 0;
}

int pthread_mutex_lock(pthread_mutex_t *mutex)
{
	if (!pthread_mutex_trylock(mutex))
		return 0;
	if (mutex->kind != PTHREAD_MUTEX_ERRORCHECK)
		plc_fault("a mutex is locked that is locked already: a controller has no thread to free it");
	return EDEADLK;
}

int pthread_mutex_unlock(pthread_mutex_t *mutex)
{
	if (!mutex->locks)
		return EPERM;
	mutex->locks--;
	return 0;
}

int pthread_rwlock_init(pthread_rwlock_t *lock, const pthread_rwlockattr_t *attributes)
{
	(void)attributes;
	return lock->readers = lock->writers = 0;
}

int pthread_rwlock_destroy(pthread_rwlock_t *lock) { return lock->readers || lock->writers ? EBUSY : 0; }

int pthread_rwlock_rdlock(pthread_rwlock_t *lock)
{
	return lock->writers ? EDEADLK : (lock->readers++, 0);
}

int pthread_rwlock_wrlock(pthread_rwlock_t *lock)
{
	return lock->writers || lock->readers ? EDEADLK : (lock->writers++, 0);
}

int pthread_rwlock_unlock(pthread_rwlock_t *lock)
{
	if (!lock->writers && !lock->readers)
		return EPERM;
	return lock->writers ? lock->writers-- : lock->readers--, 0;
}

int pthread_cond_init(pthread_cond_t *condition, const pthread_condattr_t *attributes)
{
	return (void)condition, (void)attributes, 0;
}

int pthread_cond_destroy(pthread_cond_t *condition) { return (void)condition, 0; }
int pthread_cond_signal(pthread_cond_t *condition) { return (void)condition, 0; }
int pthread_cond_broadcast(pthread_cond_t *condition) { return (void)condition, 0; }

int pthread_cond_wait(pthread_cond_t *condition, pthread_mutex_t *mutex)
{
	(void)condition, (void)mutex;
	plc_fault("pthread_cond_wait was called: a controller has no thread that could signal");
	return EDEADLK;
}

int pthread_cond_timedwait(pthread_cond_t *condition, pthread_mutex_t *mutex, const struct timespec *until)
{
	return (void)condition, (void)mutex, (void)until, ETIMEDOUT;
}
