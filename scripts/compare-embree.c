// Rays per second of Embree 4 for scripts/compare-embree, with the file that `ray_rates export` writes.
//
// The Python package brings the library without its headers: what is used of embree4/rtcore.h is
// declared here.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct {
    float origin[3], t_min, direction[3], time, t_max;
    unsigned mask, id, flags;
    float normal[3], u, v;
    unsigned primitive, geometry, instance[2];
    unsigned reserved[16]; // RTCHit grows with the build's options
} __attribute__((aligned(16))) RayHit;

enum { TRIANGLE = 0, INDEX = 0, VERTEX = 1, UINT3 = 0x5003, FLOAT3 = 0x9003, HIGH_QUALITY = 2 };

void *rtcNewDevice(const char *);
void *rtcNewScene(void *);
void *rtcNewGeometry(void *, int);
void *rtcSetNewGeometryBuffer(void *, int, unsigned, int, size_t, size_t);
void rtcCommitGeometry(void *);
unsigned rtcAttachGeometry(void *, void *);
void rtcSetSceneBuildQuality(void *, int);
void rtcCommitScene(void *);
void rtcIntersect1(void *, RayHit *, void *);
void rtcOccluded1(void *, void *, void *);

static void read_all(void *target, size_t size, FILE *file) {
    if (fread(target, 1, size, file) != size) {
        fputs("the file of rays is too short\n", stderr);
        exit(1);
    }
}

static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

static double cast(void *scene, const float (*rays)[8], unsigned count, int any_hit) {
    double sum = 0;
    for (unsigned i = 0; i < count; i++) {
        RayHit ray;
        memcpy(ray.origin, rays[i], 4 * sizeof(float));
        memcpy(ray.direction, rays[i] + 4, 3 * sizeof(float));
        ray.time = 0;
        ray.t_max = rays[i][7];
        ray.mask = ~0u;
        ray.id = ray.flags = 0;
        ray.geometry = ray.primitive = ray.instance[0] = ray.instance[1] = ~0u;
        if (any_hit) {
            rtcOccluded1(scene, &ray, NULL);
            sum += ray.t_max < 0;
        } else {
            rtcIntersect1(scene, &ray, NULL);
            sum += ray.geometry == ~0u ? 0 : ray.t_max;
        }
    }
    return sum;
}

int main(int count_arguments, char **arguments) {
    FILE *file = count_arguments == 2 ? fopen(arguments[1], "rb") : NULL;
    if (!file) {
        fputs("usage: compare-embree FILE\n", stderr);
        return 1;
    }
    void *device = rtcNewDevice("threads=1");
    void *scene = rtcNewScene(device);
    void *geometry = rtcNewGeometry(device, TRIANGLE);
    rtcSetSceneBuildQuality(scene, HIGH_QUALITY);
    unsigned triangles;
    read_all(&triangles, sizeof triangles, file);
    float *vertices = rtcSetNewGeometryBuffer(geometry, VERTEX, 0, FLOAT3, 12, 3 * (size_t)triangles);
    unsigned *indices = rtcSetNewGeometryBuffer(geometry, INDEX, 0, UINT3, 12, triangles);
    read_all(vertices, 36 * (size_t)triangles, file);
    for (unsigned i = 0; i < 3 * triangles; i++) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);

    const char *names[] = {"primary", "diffuse", "any-hit"};
    for (int set = 0; set < 3; set++) {
        unsigned count;
        read_all(&count, sizeof count, file);
        float(*rays)[8] = malloc(count * sizeof *rays);
        read_all(rays, count * sizeof *rays, file);
        double best = INFINITY, sum = 0;
        for (int pass = 0; pass < 8; pass++) {
            double start = processor_seconds();
            sum = cast(scene, rays, count, set == 2);
            best = fmin(best, processor_seconds() - start);
        }
        printf("%s\"%s\": {\"rate\": %.3f, \"sum\": %.6e}", set ? ", " : "{", names[set], count / best / 1e6, sum);
        free(rays);
    }
    puts("}");
    return 0;
}
