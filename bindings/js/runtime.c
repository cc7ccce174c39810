/* What the C library asks of a system, in place of wasi-libc's: so that the module imports a clock and
 * nothing else. Formatted text goes to memory only; nothing is written, and no file is open. */
#include <wasi/api.h>

__attribute__((import_module("icc"), import_name("clock"))) double icc_js_clock(void);

/* Nanoseconds, from a clock of milliseconds. */
__wasi_errno_t __wasi_clock_time_get(__wasi_clockid_t id, __wasi_timestamp_t precision,
                                     __wasi_timestamp_t *time)
{
    (void)id, (void)precision;
    *time = (__wasi_timestamp_t)(icc_js_clock() * 1e6);
    return __WASI_ERRNO_SUCCESS;
}

__wasi_errno_t __wasi_fd_write(__wasi_fd_t file, const __wasi_ciovec_t *parts, size_t n_parts,
                               __wasi_size_t *written)
{
    (void)file, (void)parts, (void)n_parts, (void)written;
    return __WASI_ERRNO_BADF;
}

__wasi_errno_t __wasi_fd_seek(__wasi_fd_t file, __wasi_filedelta_t offset, __wasi_whence_t whence,
                              __wasi_filesize_t *position)
{
    (void)file, (void)offset, (void)whence, (void)position;
    return __WASI_ERRNO_BADF;
}

__wasi_errno_t __wasi_fd_close(__wasi_fd_t file)
{
    (void)file;
    return __WASI_ERRNO_BADF;
}

__wasi_errno_t __wasi_fd_fdstat_get(__wasi_fd_t file, __wasi_fdstat_t *status)
{
    (void)file, (void)status;
    return __WASI_ERRNO_BADF;
}
