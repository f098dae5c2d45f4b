// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

/* One part of a step in plain C: the exciter's force, the two-pole half space, the parabolic soil force. Included by
   reference_phases.h. */

#ifndef REFERENCE_PARTS_H
#define REFERENCE_PARTS_H

#include <math.h>
#include <stdbool.h>

enum { DEPTH, VELOCITY, FORCE, SURFACE, SURFACE_VELOCITY, PLASTIC, DATUM, PHASE, UNSETTLED_STEPS };
enum {
    STEP,
    OMEGA,
    MASS,
    STATIC_LOAD,
    PLASTIC_COMPLIANCE,
    STATIC_COMPLIANCE,
    START_ACCELERATION,
    ACCELERATION_RATE,
    HORIZONTAL_SINE,
    HORIZONTAL_COSINE,
    NATURAL_FREQUENCY,
    QUALITY,
    VERTICAL_SINE
};
enum { LOADING, UNLOADING, AIR };

typedef struct { double d, v, force, e, w, q, datum; } State;
typedef struct { double ramp_2, ramp, step; } Answer;
typedef struct { double c1, c2, c2_rate; } Motion;
typedef struct { double value, rate; } Known;
typedef struct { double velocity, travel; } Moved;
typedef struct { double slope_start, slope_end, d, v, force, e, w; } Result;

/* The exciter's force over a part of a step: integrals of cos and sin, once and twice, with weights 1 and t. */
typedef struct {
    double cos_0, sin_0, cos_1, sin_1, travel_cos_0, travel_sin_0, travel_cos_1, travel_sin_1;
} Turn;

/* Joint oscillator of drum and surface over a part of a step; Gauss points of the exciter's force. */
typedef struct {
    Motion motion;
    double pull[3], pull_rate[3], node_time[3], node_cos[3], node_sin[3], end_cos, end_sin;
    double length, share, decay, stiffness;
} Joint;

/* Everything that stays the same over a revolution. */
typedef struct {
    double h, omega, mass, inverse_mass, load, plastic, rate;
    bool two_pole;
    double natural, quality, compliance;     /* two-pole */
    double ramp_h, step_h;                   /* finite memory */
} Model;

static inline Turn turn_over(double x, double omega) {
    double y = omega * x, yy = y * y, xx = x * x;
    Turn t;
    t.cos_0 = x * (1.0 - yy * (1.0 / 6.0 - yy * (1.0 / 120.0 - yy / 5040.0)));
    t.sin_0 = x * y * (0.5 - yy * (1.0 / 24.0 - yy * (1.0 / 720.0 - yy / 40320.0)));
    t.cos_1 = xx * (0.5 - yy * (1.0 / 8.0 - yy * (1.0 / 144.0 - yy / 5760.0)));
    t.sin_1 = xx * y * (1.0 / 3.0 - yy * (1.0 / 30.0 - yy * (1.0 / 840.0 - yy / 45360.0)));
    t.travel_cos_0 = xx * (0.5 - yy * (1.0 / 24.0 - yy * (1.0 / 720.0 - yy / 40320.0)));
    t.travel_sin_0 = xx * y * (1.0 / 6.0 - yy * (1.0 / 120.0 - yy * (1.0 / 5040.0 - yy / 362880.0)));
    t.travel_cos_1 = xx * x * (1.0 / 6.0 - yy * (1.0 / 40.0 - yy * (1.0 / 1008.0 - yy / 51840.0)));
    t.travel_sin_1 = xx * x * y * (1.0 / 12.0 - yy * (1.0 / 180.0 - yy / 6720.0));
    return t;
}

/* Sine and cosine of an angle up to 2 pi/32, to rounding. */
static inline void small_turn(double angle, double *sine, double *cosine) {
    double y = angle * angle;
    *sine = angle * (1.0 - y * (1.0 / 6.0 - y * (1.0 / 120.0 - y * (1.0 / 5040.0 - y * (1.0 / 362880.0 -
                     y / 39916800.0)))));
    *cosine = 1.0 - y * (0.5 - y * (1.0 / 24.0 - y * (1.0 / 720.0 - y * (1.0 / 40320.0 - y * (1.0 / 3628800.0 -
                    y / 479001600.0)))));
}

static inline Moved exciter_motion(const Turn *t, double sine, double cosine, double amplitude, double rate) {
    Moved m;
    m.velocity = sine * (amplitude * t->cos_0 + rate * t->cos_1) + cosine * (amplitude * t->sin_0 + rate * t->sin_1);
    m.travel = sine * (amplitude * t->travel_cos_0 + rate * t->travel_cos_1) +
               cosine * (amplitude * t->travel_sin_0 + rate * t->travel_sin_1);
    return m;
}

static inline Motion oscillation(double x, double decay, double stiffness) {
    double square = decay * decay - stiffness, turn = sqrt(fabs(square)) * x;
    double c2, even;
    if (turn < 0.03) {
        double damped = exp(-decay * x), y = square * x * x;
        c2 = damped * x * (1.0 + y * (1.0 / 6.0 + y * (1.0 / 120.0 + y * (1.0 / 5040.0))));
        even = damped * (1.0 + y * (0.5 + y * (1.0 / 24.0 + y * (1.0 / 720.0 + y / 40320.0))));
    } else if (square > 0.0) {
        double slow = 0.5 * exp(turn - decay * x), fast = 0.5 * exp(-turn - decay * x);
        c2 = (slow - fast) / turn * x;
        even = slow + fast;
    } else {
        double damped = exp(-decay * x);
        c2 = damped * sin(turn) / turn * x;
        even = damped * cos(turn);
    }
    Motion m = {even + decay * c2, c2, even - decay * c2};
    return m;
}

/* Free solutions at 2 x from those at x. */
static inline Motion twice(Motion half, double stiffness) {
    double both = stiffness * half.c2 * half.c2;
    Motion m = {half.c1 * half.c1 - both, half.c2 * (half.c1 + half.c2_rate), half.c2_rate * half.c2_rate - both};
    return m;
}

static inline Answer two_pole_answer(const Model *m, double x, const Motion *motion) {
    double stiffness = m->natural * m->natural, damping = m->natural / m->quality;
    double step = 1.0 - motion->c1;
    double ramp = x - motion->c2 - damping / stiffness * step;
    double ramp_2 = 0.5 * x * x - (step + damping * ramp) / stiffness;
    Answer answer = {m->compliance * ramp_2, m->compliance * ramp, m->compliance * step};
    return answer;
}

static inline Motion two_pole_motion(const Model *m, double x) {
    return oscillation(x, 0.5 * m->natural / m->quality, m->natural * m->natural);
}

static inline Known two_pole_free(const Model *m, const State *s, const Motion *motion) {
    double rest = m->compliance * s->force, y = s->e - rest;
    Known known = {rest + y * motion->c1 + s->w * motion->c2,
                   s->w * motion->c2_rate - m->natural * m->natural * y * motion->c2};
    return known;
}

static inline double joint_force(const Model *m, double e, double w, double thrust) {
    double stiffness = m->natural * m->natural;
    return (m->load * m->inverse_mass - thrust + stiffness * e + m->natural / m->quality * w) /
           (stiffness * m->compliance + m->inverse_mass);
}

static inline Joint joint_over(const Model *m, double x) {
    const double offset = 0.5 * sqrt(0.6);
    const double node[3] = {0.5 - offset, 0.5, 0.5 + offset}, weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double soil_mass = 1.0 / (m->natural * m->natural * m->compliance), total = m->mass + soil_mass;
    Joint j;
    j.length = x;
    j.share = m->mass / total;
    j.decay = 0.5 * soil_mass * m->natural / m->quality / total;
    j.stiffness = 1.0 / (m->compliance * total);
    /* The Gauss points lie symmetrically about the middle. */
    Motion half = oscillation(0.5 * x, j.decay, j.stiffness), apart = oscillation(offset * x, j.decay, j.stiffness);
    Motion last = oscillation((1.0 - node[2]) * x, j.decay, j.stiffness);
    j.motion = twice(half, j.stiffness);
    double c2[3] = {half.c1 * apart.c2 + half.c2 * apart.c2_rate, half.c2, last.c2};
    double c2_rate[3] = {half.c2_rate * apart.c2_rate - j.stiffness * half.c2 * apart.c2, half.c2_rate, last.c2_rate};
    for (int n = 0; n < 3; n++) {
        j.pull[n] = j.share * weight[n] * x * c2[n];
        j.pull_rate[n] = j.share * weight[n] * x * c2_rate[n];
        j.node_time[n] = node[n] * x;
        small_turn(m->omega * node[n] * x, &j.node_sin[n], &j.node_cos[n]);
    }
    small_turn(m->omega * x, &j.end_sin, &j.end_cos);
    return j;
}

/* Unloading on the two-pole half space: drum and surface move as one. */
static inline Result joint_part(const Model *m, const Joint *j, const State *s, double sine, double cosine,
                                double amplitude) {
    double rest = m->compliance * m->load, y = s->e - rest, rate = m->rate, pull = 0.0, pull_rate = 0.0;
    for (int n = 0; n < 3; n++) {
        double thrust = (amplitude + rate * j->node_time[n]) * (sine * j->node_cos[n] + cosine * j->node_sin[n]);
        pull += j->pull[n] * thrust;
        pull_rate += j->pull_rate[n] * thrust;
    }
    double end = amplitude + rate * j->length;
    double sine_end = sine * j->end_cos + cosine * j->end_sin, cosine_end = cosine * j->end_cos - sine * j->end_sin;
    double thrust = end * sine_end;
    Result r;
    r.e = rest + y * j->motion.c1 + s->w * j->motion.c2 - pull;
    r.w = s->w * j->motion.c2_rate - j->stiffness * y * j->motion.c2 - pull_rate;
    r.force = joint_force(m, r.e, r.w, thrust);
    r.d = r.e + s->q + s->datum;
    r.v = r.w;
    double a_1 = (m->load - r.force) * m->inverse_mass - thrust;
    double a_0 = -2.0 * j->decay * s->w - j->stiffness * y - j->share * amplitude * sine;
    r.slope_end = m->mass * (2.0 * j->decay * a_1 + j->stiffness * r.w +
                             (j->share - 1.0) * (end * m->omega * cosine_end + rate * sine_end));
    r.slope_start = m->mass * (2.0 * j->decay * a_0 + j->stiffness * s->w +
                               (j->share - 1.0) * (amplitude * m->omega * cosine + rate * sine));
    return r;
}

/* x seconds in one phase under a parabolic force. */
static inline Result solve_part(const Model *m, int phase, double x, bool parabolic, const State *s,
                                double slope_before, Moved moved_y, Moved moved, Known known_y, Known known,
                                Answer at_y, Answer at) {
    double sinking = (m->load - s->force) * m->inverse_mass;
    double x_2 = x * x, x_3 = x_2 * x * m->inverse_mass, x_4 = x_3 * x;
    double d_free = s->d + x * s->v + 0.5 * x_2 * sinking - moved.travel;
    double v_free = s->v + x * sinking - moved.velocity;
    if (phase == AIR) {
        Result r = {0.0, 0.0, d_free, v_free, 0.0, known.value - slope_before * at.ramp,
                    known.rate - slope_before * at.step};
        return r;
    }
    double right, right_y, a, b, a_y, b_y;
    if (phase == LOADING) {
        double rest = s->q + s->datum;
        right = d_free - rest - known.value + slope_before * at.ramp;
        right_y = s->d + 0.5 * x * s->v + 0.125 * x_2 * sinking - moved_y.travel - rest - known_y.value +
                  slope_before * at_y.ramp;
        a = x_3 / 6.0 + m->plastic * x + at.ramp;
        b = x_4 / 12.0 + x * at.ramp - 2.0 * at.ramp_2;
        a_y = x_3 / 48.0 + 0.5 * m->plastic * x + at_y.ramp;
        b_y = x_4 / 64.0 + 0.25 * m->plastic * x_2 + x * at_y.ramp - 2.0 * at_y.ramp_2;
    } else {
        right = v_free - known.rate + slope_before * at.step;
        right_y = s->v + 0.5 * x * sinking - moved_y.velocity - known_y.rate + slope_before * at_y.step;
        a = 0.5 * x_2 * m->inverse_mass + at.step;
        b = x_3 / 6.0 + x * at.step - 2.0 * at.ramp;
        a_y = 0.125 * x_2 * m->inverse_mass + at_y.step;
        b_y = x_3 / 12.0 + x * at_y.step - 2.0 * at_y.ramp;
    }
    double sigma, kappa = 0.0;
    if (parabolic) {
        double inverse = 1.0 / (a * b_y - a_y * b);
        sigma = (right * b_y - right_y * b) * inverse;
        kappa = (a * right_y - a_y * right) * inverse;
    } else {
        sigma = right / a;
    }
    double jump = sigma + kappa * x - slope_before;
    Result r = {sigma + kappa * x,
                sigma - kappa * x,
                d_free - sigma * x_3 / 6.0 - kappa * x_4 / 12.0,
                v_free - 0.5 * sigma * x_2 * m->inverse_mass - kappa * x_3 / 6.0,
                s->force + sigma * x,
                known.value + jump * at.ramp - 2.0 * kappa * at.ramp_2,
                known.rate + jump * at.step - 2.0 * kappa * at.ramp};
    return r;
}

#endif
