// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

/* The phases of Figure 13 in plain C: phase changes located inside a step, the fresh-soil rule. Included by
   reference_loop.c. */

#ifndef REFERENCE_PHASES_H
#define REFERENCE_PHASES_H

#include "reference_parts.h"

enum { STEP_END, LOADING_ENDS, RELOADING, LIFT_OFF, CONTACT, APEX };

#define MAX_SPLITS 24
#define STILL_VELOCITY 1e-12
#define STILL_SLOPE 1.0
#define SHORTEST_PART 1e-6
#define SHORTEST_PARABOLA 0.05
#define ROOT_CLOSE 1e-4
#define ROOT_ITERATIONS 40

typedef struct { double time, slope, curvature; } Bend;

/* A step that is being split: where it starts, and its bends so far. */
typedef struct {
    double sine, cosine, amplitude;
    double e_0, w_0, e_1, w_1, a, b;         /* finite memory: free motion */
    Bend bends[MAX_SPLITS + 3];
    int count;
} Split;

static inline Answer answer_within(const Model *m, double x) {
    double u = x / m->h;
    Answer answer = {m->h * u * u * u * ((1.0 - 0.5 * u) * m->ramp_h + m->h * m->step_h * (0.25 * u - 1.0 / 3.0)),
                     u * u * ((3.0 - 2.0 * u) * m->ramp_h + (u - 1.0) * m->h * m->step_h),
                     u * (6.0 * (1.0 - u) * m->ramp_h / m->h + (3.0 * u - 2.0) * m->step_h)};
    return answer;
}

static Known known_within(const Model *m, const Split *p, double x) {
    double h = m->h, u = x / h, v = 1.0 - u, more = p->a + p->b * (u - 2.0);
    double e = (1.0 + 2.0 * u) * v * v * p->e_0 + u * v * v * h * p->w_0 + u * u * (3.0 - 2.0 * u) * p->e_1 -
               u * u * v * h * p->w_1 + u * u * v * v * more;
    double w = 6.0 * u * v * (p->e_1 - p->e_0) / h + v * (1.0 - 3.0 * u) * p->w_0 + u * (3.0 * u - 2.0) * p->w_1 +
               u * v * (2.0 * (1.0 - 2.0 * u) * more + u * v * p->b) / h;
    for (int j = 0; j <= p->count; j++) {
        Answer answer = answer_within(m, x - p->bends[j].time);
        e += p->bends[j].slope * answer.ramp + p->bends[j].curvature * answer.ramp_2;
        w += p->bends[j].slope * answer.step + p->bends[j].curvature * answer.ramp;
    }
    Known known = {e, w};
    return known;
}

/* The part of a split step from t to t + x. */
static Result part(const Model *m, const Split *p, int phase, double t, double x, double slope_before, const State *s) {
    double cos_t, sin_t;
    small_turn(m->omega * t, &sin_t, &cos_t);
    double sine = p->sine * cos_t + p->cosine * sin_t, cosine = p->cosine * cos_t - p->sine * sin_t;
    double amplitude = p->amplitude + m->rate * t;
    Answer at_y, at;
    Known known_y, known;
    if (m->two_pole) {
        if (phase == UNLOADING) {
            Joint joint = joint_over(m, x);
            return joint_part(m, &joint, s, sine, cosine, amplitude);
        }
        Motion half = two_pole_motion(m, 0.5 * x), motion = twice(half, m->natural * m->natural);
        at_y = two_pole_answer(m, 0.5 * x, &half);
        known_y = two_pole_free(m, s, &half);
        at = two_pole_answer(m, x, &motion);
        known = two_pole_free(m, s, &motion);
        slope_before = 0.0;
    } else {
        at_y = answer_within(m, 0.5 * x);
        at = answer_within(m, x);
        known_y = known_within(m, p, t + 0.5 * x);
        known = known_within(m, p, t + x);
    }
    Turn half = turn_over(0.5 * x, m->omega), whole = turn_over(x, m->omega);
    return solve_part(m, phase, x, x > SHORTEST_PARABOLA * m->h, s, slope_before,
                      exciter_motion(&half, sine, cosine, amplitude, m->rate),
                      exciter_motion(&whole, sine, cosine, amplitude, m->rate), known_y, known, at_y, at);
}

static inline double event_value(int event, const Result *r, const State *s) {
    switch (event) {
    case LOADING_ENDS: return r->v - r->w;
    case RELOADING: return -r->slope_end;
    case LIFT_OFF: return r->force;
    case CONTACT: return r->e + s->q + s->datum - r->d;
    default: return -r->v;
    }
}

/* About where the cubic through values and rates at 0 and `length` falls through zero. */
static inline double cubic_root(double length, double f_0, double rate_0, double f_1, double rate_1) {
    double rise = f_1 - f_0, a = length * rate_0, b = length * rate_1;
    double c_2 = 3.0 * rise - 2.0 * a - b, c_3 = a + b - 2.0 * rise, u = -f_0 / rise;
    for (int n = 0; n < 2; n++)
        u -= (f_0 + u * (a + u * (c_2 + u * c_3))) / (a + u * (2.0 * c_2 + 3.0 * u * c_3));
    return length * u;
}

static inline double thrust_at(const Model *m, const Split *p, double t) {
    double sin_t, cos_t;
    small_turn(m->omega * t, &sin_t, &cos_t);
    return (p->amplitude + m->rate * t) * (p->sine * cos_t + p->cosine * sin_t);
}

/* About where the event is, from the part that reaches over it. */
static double guess(const Model *m, const Split *p, int event, double at_start, double at_end, double t, double length,
                    const State *s, const Result *r) {
    if (event == CONTACT)
        return cubic_root(length, at_start, s->w - s->v, at_end, r->w - r->v);
    if (event == LIFT_OFF)
        return cubic_root(length, at_start, r->slope_start, at_end, r->slope_end);
    if (event == APEX)
        return cubic_root(length, at_start, thrust_at(m, p, t) - (m->load - s->force) * m->inverse_mass, at_end,
                          thrust_at(m, p, t + length) - (m->load - r->force) * m->inverse_mass);
    if (r->slope_start * r->slope_end < 0.0)
        return length * r->slope_start / (r->slope_start - r->slope_end);
    return length * at_start / (at_start - at_end);
}

/* Time into the part at which the event happens: inverse quadratic interpolation in a bracket, from a guess. */
static double locate(const Model *m, const Split *p, int event, double at_start, double at_end, double length,
                     int phase, double t, double slope_before, const State *s, const Result *whole) {
    if (at_start <= 0.0)
        return 0.0;
    double low = 0.0, f_low = at_start, high = length, f_high = at_end;
    double x = guess(m, p, event, at_start, at_end, t, length, s, whole);
    if (!(low < x && x < high))
        x = high - f_high * (high - low) / (f_high - f_low);
    for (int n = 0; n < ROOT_ITERATIONS; n++) {
        Result r = part(m, p, phase, t, x, slope_before, s);
        double f = event_value(event, &r, s), last = x;
        double below = (x - low) / (f - f_low), above = (high - x) / (f_high - f);
        x = last - f * below + f * f_low * (above - below) / (f_high - f_low);
        if (f <= 0.0)
            high = last, f_high = f;
        else
            low = last, f_low = f;
        if (!(low < x && x < high)) {
            x = high - f_high * (high - low) / (f_high - f_low);
            if (!(low < x && x < high))
                return last;
        }
        if (fabs(x - last) < ROOT_CLOSE * m->h)
            break;
    }
    return x;
}

/* The fresh-soil rule, at the drum's apex. */
static inline void renew(const Model *m, State *s, int phase) {
    double fresh = m->plastic * (phase == AIR ? 0.0 : s->force);
    s->datum = fmax(s->datum, s->d - s->e - fresh);
    s->q = phase == AIR ? fresh : s->d - s->e - s->datum;
}

/* A step in which phases change, r what it comes to if none did; returns the phase at its end. */
static int split_step(const Model *m, Split *p, int phase, State *s, Result r, long *unsettled_steps) {
    static const double still[] = {0.0, STILL_VELOCITY, STILL_SLOPE, 0.0, 0.0, 0.0};
    double t = 0.0, slope_before = 0.0;
    p->count = 0;
    p->bends[0] = (Bend){0.0, 0.0, 0.0};
    for (int split = 0; split <= MAX_SPLITS; split++) {
        double rest = m->h - t, length = rest, at_start = 0.0;
        if (rest <= 0.0)
            break;
        if (split > 0)
            r = part(m, p, phase, t, rest, slope_before, s);
        int event = STEP_END;
        if (split == MAX_SPLITS)
            ++*unsettled_steps;
        else if (phase == LOADING)
            event = LOADING_ENDS, at_start = s->v - s->w;
        else if (phase == AIR)
            event = CONTACT, at_start = s->e + s->q + s->datum - s->d;
        else if (r.force < 0.0)
            event = LIFT_OFF, at_start = s->force;
        else
            event = RELOADING, at_start = -r.slope_start;
        if (event != STEP_END) {
            double at_end = event_value(event, &r, s);
            if (at_end < -still[event])
                length = locate(m, p, event, at_start, at_end, rest, phase, t, slope_before, s, &r);
            else if (event == LOADING_ENDS && r.slope_start + r.slope_end < -STILL_SLOPE)
                length = 0.0;
            else
                event = STEP_END;
        }
        if (s->v < 0.0 && r.v >= 0.0 && r.v - s->v > STILL_VELOCITY && split < MAX_SPLITS) {
            double apex = locate(m, p, APEX, -s->v, -r.v, rest, phase, t, slope_before, s, &r);
            if (apex < length || event == STEP_END)
                event = APEX, length = apex;
        }
        if (rest - length < SHORTEST_PART * m->h)
            length = rest;
        if (length > SHORTEST_PART * m->h) {
            if (length < rest)
                r = part(m, p, phase, t, length, slope_before, s);
            double curvature = (r.slope_end - r.slope_start) / length;
            p->bends[p->count].slope = r.slope_start - slope_before;
            p->bends[p->count].curvature += curvature;
            slope_before = r.slope_end;
            t = length < rest ? t + length : m->h;
            p->bends[++p->count] = (Bend){t, 0.0, -curvature};
            if (phase == LOADING)
                s->q += m->plastic * (r.force - s->force);
            else if (phase == UNLOADING)
                s->q = r.d - r.e - s->datum;
            s->d = r.d, s->v = r.v, s->e = r.e, s->w = r.w;
            s->force = fmax(r.force, 0.0);
        }
        if (event == LOADING_ENDS) {
            phase = UNLOADING;
            if (m->two_pole)
                s->force = fmax(joint_force(m, s->e, s->w, thrust_at(m, p, t)), 0.0);
        } else if (event == RELOADING || event == CONTACT) {
            phase = LOADING;
        } else if (event == LIFT_OFF) {
            phase = AIR;
            s->force = 0.0;
        } else if (event == APEX) {
            s->v = 0.0;
            if (phase == UNLOADING)
                s->w = 0.0;
            renew(m, s, phase);
        } else {
            break;
        }
    }
    p->bends[p->count++].slope = -slope_before;
    return phase;
}

#endif
