/* The functions of carom.h: they bring the arrays that the compiled kernels work in.
 *
 * A kernel takes one block of words: an array is its address and its shape, a number itself. The
 * shapes of the scratch arrays are written into kernels.h when the library is built.
 */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "export.h"
#include "kernels.h"

enum { MAX_WORDS = 96, MOST_DIMENSIONS = 3 };

typedef struct {
    int dimensions;
    int64_t shape[MOST_DIMENSIONS];
} carom_array;

typedef struct {
    int64_t words[MAX_WORDS];
    int count;
    char *room;
} carom_block;

static const carom_array elastic_scratch[] = CAROM_ELASTIC_SCRATCH;
static const carom_array lossy_scratch[] = CAROM_LOSSY_SCRATCH;

static int64_t items(const carom_array *array)
{
    int64_t product = 1;
    for (int i = 0; i < array->dimensions; i++) product *= array->shape[i];
    return product;
}

static void add_array(carom_block *block, const void *data, const carom_array *array)
{
    block->words[block->count++] = (int64_t)(intptr_t)data;
    for (int i = 0; i < array->dimensions; i++) block->words[block->count++] = array->shape[i];
}

static void add_vector(carom_block *block, const void *data, size_t n)
{
    const carom_array array = {1, {(int64_t)n}};
    add_array(block, data, &array);
}

static void add_number(carom_block *block, double number)
{
    memcpy(block->words + block->count++, &number, sizeof number);
}

/* Add scratch arrays, all in one piece of memory; items of eight bytes stand for smaller ones. */
static int add_scratch(carom_block *block, const carom_array *arrays, size_t count)
{
    size_t total = 1, done = 0;
    for (size_t i = 0; i < count; i++) total += (size_t)items(arrays + i);
    block->room = calloc(total, sizeof(double));
    if (block->room == NULL) return -1;
    for (size_t i = 0; i < count; i++) {
        add_array(block, block->room + done * sizeof(double), arrays + i);
        done += (size_t)items(arrays + i);
    }
    return 0;
}

CAROM_API int carom_rebound_on_plate(
    size_t n, const double *psi, const double *chi, const double *lambda,
    double *psi_out, int8_t *status)
{
    carom_block block = {.count = 0};
    int64_t *sequence = malloc((n ? n : 1) * sizeof *sequence);
    int failed = sequence == NULL;
    if (!failed) {
        add_vector(&block, psi, n);
        add_vector(&block, chi, n);
        add_vector(&block, lambda, n);
        failed = add_scratch(&block, elastic_scratch, sizeof elastic_scratch / sizeof *elastic_scratch);
    }
    if (!failed) {
        add_vector(&block, psi_out, n);
        add_vector(&block, status, n);
        add_vector(&block, sequence, n);
        failed = CAROM_ELASTIC(block.words);
    }
    free(block.room);
    free(sequence);
    return failed ? -1 : 0;
}

CAROM_API int carom_motion_on_plate(
    size_t n, const double *lambda, double *restitution, double *duration)
{
    carom_block block = {.count = 0};
    const carom_array table = {2, {(int64_t)n, CAROM_NUMBERS}};
    double *numbers = malloc((n ? n : 1) * CAROM_NUMBERS * sizeof *numbers);
    int failed = numbers == NULL;
    if (!failed) {
        add_vector(&block, lambda, n);
        add_number(&block, CAROM_STEP_TOLERANCE);
        failed = add_scratch(&block, elastic_scratch, CAROM_WORK_ARRAYS);
    }
    if (!failed) {
        add_array(&block, numbers, &table);
        failed = CAROM_MOTION(block.words);
    }
    for (size_t i = 0; !failed && i < n; i++) {
        restitution[i] = numbers[i * CAROM_NUMBERS + CAROM_RESTITUTION];
        duration[i] = numbers[i * CAROM_NUMBERS + CAROM_DURATION];
    }
    free(block.room);
    free(numbers);
    return failed ? -1 : 0;
}

CAROM_API int carom_rebound(
    size_t n, const double *psi, const double *chi, double *psi_out, int8_t *status)
{
    double *thick = calloc(n ? n : 1, sizeof *thick);
    int failed = thick == NULL || carom_rebound_on_plate(n, psi, chi, thick, psi_out, status);
    free(thick);
    return failed ? -1 : 0;
}

CAROM_API int carom_rebound_viscous(
    size_t n, const double *psi, const double *chi, const double *alpha,
    double *psi_out, double *restitution, int8_t *status)
{
    carom_block block = {.count = 0};
    const carom_array table = {2, {(int64_t)n, CAROM_NUMBERS}};
    double *numbers = malloc((n ? n : 1) * CAROM_NUMBERS * sizeof *numbers);
    int failed = numbers == NULL;
    if (!failed) {
        add_vector(&block, psi, n);
        add_vector(&block, chi, n);
        add_vector(&block, alpha, n);
        add_number(&block, CAROM_TOLERANCE);
        failed = add_scratch(&block, lossy_scratch, sizeof lossy_scratch / sizeof *lossy_scratch);
    }
    if (!failed) {
        add_array(&block, numbers, &table);
        add_vector(&block, status, n);
        failed = CAROM_LOSSY(block.words);
    }
    for (size_t i = 0; !failed && i < n; i++) {
        const double *found = numbers + i * CAROM_NUMBERS;
        if (alpha[i] >= 0.0 && alpha[i] < CAROM_NEARLY_ELASTIC) {
            failed = carom_rebound(1, psi + i, chi + i, psi_out + i, status + i);
            restitution[i] = status[i] == 0 ? 1.0 : (double)NAN;
            continue;
        }
        psi_out[i] = status[i] == 0 ? found[CAROM_PSI_OUT] : (double)NAN;
        restitution[i] = status[i] == 0 ? found[CAROM_RESTITUTION] : (double)NAN;
    }
    free(block.room);
    free(numbers);
    return failed ? -1 : 0;
}

CAROM_API const char *carom_status_message(int status)
{
    static const char *const messages[] = CAROM_MESSAGES;
    const int count = (int)(sizeof messages / sizeof *messages);
    return status >= 0 && status < count ? messages[status] : "no status";
}
