// Copyright 2026 The roller_sim_ros developers
// SPDX-License-Identifier: Apache-2.0

/* Eight two-pole trajectories side by side in plain C: what the lanes of roller_sim_ros/sweep cost without Python.

   Whole steps in loops over the lanes, one for each phase, without branches; steps in which a phase changes one lane at a
   time, by the split_step of reference_phases.h. Compiled and called by sweep.py, which checks the final states. */

#include "reference_phases.h"

#define LANES 8
typedef double Lane[LANES];

typedef struct {
    Lane d, v, force, e, w, q, datum, phase, waits;
    Lane h, half_square, inverse_mass, load, weight, plastic, compliance, stiffness, damping, rest, amplitude, omega;
    Lane travel_sine, travel_cosine, velocity_sine, velocity_cosine, middle_sine, middle_cosine;
    Lane c1, c2, c2_rate, middle_c1, middle_c2;
    Lane ramp, ramp_2, step, force_end, force_middle, bulge_end, bulge_middle, d_slope, d_bulge, v_slope, v_bulge;
    Lane joint_c1, joint_c2, joint_c2_rate, joint_stiffness, joint_decay, share, inverse_sum, mass;
    Lane pull_sine, pull_cosine, pull_rate_sine, pull_rate_cosine, end_sine, end_cosine;
} Lanes;

static void load_lane(Lanes *x, int n, const Model *m, const double *constants, const double *state) {
    double h = m->h, omega = m->omega, amplitude = constants[VERTICAL_SINE] * constants[START_ACCELERATION];
    Turn whole = turn_over(h, omega), half = turn_over(0.5 * h, omega);
    Moved sine = exciter_motion(&whole, 1.0, 0.0, amplitude, 0.0), cosine = exciter_motion(&whole, 0.0, 1.0, amplitude, 0.0);
    Motion motion_y = two_pole_motion(m, 0.5 * h), motion = two_pole_motion(m, h);
    Answer at_y = two_pole_answer(m, 0.5 * h, &motion_y), at = two_pole_answer(m, h, &motion);
    Joint joint = joint_over(m, h);
    double cube = h * h * h * m->inverse_mass, fourth = cube * h;
    double a = cube / 6.0 + m->plastic * h + at.ramp, b = fourth / 12.0 + h * at.ramp - 2.0 * at.ramp_2;
    double a_y = cube / 48.0 + 0.5 * m->plastic * h + at_y.ramp;
    double b_y = fourth / 64.0 + 0.25 * m->plastic * h * h + h * at_y.ramp - 2.0 * at_y.ramp_2;
    double determinant = a * b_y - a_y * b;
    x->d[n] = state[DEPTH], x->v[n] = state[VELOCITY], x->force[n] = state[FORCE], x->e[n] = state[SURFACE];
    x->w[n] = state[SURFACE_VELOCITY], x->q[n] = state[PLASTIC], x->datum[n] = state[DATUM], x->phase[n] = state[PHASE];
    x->waits[n] = 0.0, x->h[n] = h, x->half_square[n] = 0.5 * h * h, x->mass[n] = m->mass;
    x->inverse_mass[n] = m->inverse_mass, x->load[n] = m->load, x->weight[n] = m->load * m->inverse_mass;
    x->plastic[n] = m->plastic, x->compliance[n] = m->compliance, x->stiffness[n] = m->natural * m->natural;
    x->damping[n] = m->natural / m->quality, x->rest[n] = m->compliance * m->load, x->amplitude[n] = amplitude;
    x->omega[n] = omega, x->velocity_sine[n] = sine.velocity, x->velocity_cosine[n] = cosine.velocity;
    x->travel_sine[n] = sine.travel, x->travel_cosine[n] = cosine.travel;
    x->middle_sine[n] = exciter_motion(&half, 1.0, 0.0, amplitude, 0.0).travel;
    x->middle_cosine[n] = exciter_motion(&half, 0.0, 1.0, amplitude, 0.0).travel;
    x->c1[n] = motion.c1, x->c2[n] = motion.c2, x->c2_rate[n] = motion.c2_rate;
    x->middle_c1[n] = motion_y.c1, x->middle_c2[n] = motion_y.c2;
    x->ramp[n] = at.ramp, x->ramp_2[n] = 2.0 * at.ramp_2, x->step[n] = at.step;
    x->force_end[n] = b_y / determinant, x->force_middle[n] = -b / determinant;
    x->bulge_end[n] = -a_y / determinant, x->bulge_middle[n] = a / determinant;
    x->d_slope[n] = cube / 6.0, x->d_bulge[n] = fourth / 12.0;
    x->v_slope[n] = 0.5 * h * h * m->inverse_mass, x->v_bulge[n] = cube / 6.0;
    x->joint_c1[n] = joint.motion.c1, x->joint_c2[n] = joint.motion.c2, x->joint_c2_rate[n] = joint.motion.c2_rate;
    x->joint_stiffness[n] = joint.stiffness, x->joint_decay[n] = 2.0 * joint.decay, x->share[n] = joint.share - 1.0;
    x->inverse_sum[n] = 1.0 / (m->natural * m->natural * m->compliance + m->inverse_mass);
    x->pull_sine[n] = x->pull_cosine[n] = x->pull_rate_sine[n] = x->pull_rate_cosine[n] = 0.0;
    for (int k = 0; k < 3; k++) {
        x->pull_sine[n] += amplitude * joint.pull[k] * joint.node_cos[k];
        x->pull_cosine[n] += amplitude * joint.pull[k] * joint.node_sin[k];
        x->pull_rate_sine[n] += amplitude * joint.pull_rate[k] * joint.node_cos[k];
        x->pull_rate_cosine[n] += amplitude * joint.pull_rate[k] * joint.node_sin[k];
    }
    x->end_sine[n] = amplitude * joint.end_cos, x->end_cosine[n] = amplitude * joint.end_sin;
}

static void step_in_air(Lanes *restrict x, double sine, double cosine) {
    for (int n = 0; n < LANES; n++) {
        double v = x->v[n], e = x->e[n], w = x->w[n];
        double d_1 = x->d[n] + x->h[n] * v + x->half_square[n] * x->weight[n] - sine * x->travel_sine[n] - cosine * x->travel_cosine[n];
        double v_1 = v + x->h[n] * x->weight[n] - sine * x->velocity_sine[n] - cosine * x->velocity_cosine[n];
        double e_1 = e * x->c1[n] + w * x->c2[n], w_1 = w * x->c2_rate[n] - x->stiffness[n] * e * x->c2[n];
        int here = x->phase[n] == AIR, apex = (v < 0.0) & (v_1 >= 0.0) & (v_1 - v > STILL_VELOCITY);
        int waits = here & ((d_1 > e_1 + x->q[n] + x->datum[n]) | (apex & (d_1 >= e_1 + x->datum[n]))), goes = here & !waits;
        x->d[n] = goes ? d_1 : x->d[n], x->v[n] = goes ? v_1 : v, x->e[n] = goes ? e_1 : e, x->w[n] = goes ? w_1 : w;
        x->q[n] = goes & apex ? 0.0 : x->q[n];
        x->waits[n] = waits ? 1.0 : x->waits[n];
    }
}

static void step_unloading(Lanes *restrict x, double sine, double cosine) {
    for (int n = 0; n < LANES; n++) {
        double v = x->v[n], y = x->e[n] - x->rest[n], w = x->w[n];
        double thrust = sine * x->end_sine[n] + cosine * x->end_cosine[n];
        double thrust_rate = x->omega[n] * (cosine * x->end_sine[n] - sine * x->end_cosine[n]);
        double e_1 = x->rest[n] + y * x->joint_c1[n] + w * x->joint_c2[n] - sine * x->pull_sine[n] - cosine * x->pull_cosine[n];
        double w_1 = w * x->joint_c2_rate[n] - x->joint_stiffness[n] * y * x->joint_c2[n] - sine * x->pull_rate_sine[n] -
                     cosine * x->pull_rate_cosine[n];
        double force_1 = (x->weight[n] - thrust + x->stiffness[n] * e_1 + x->damping[n] * w_1) * x->inverse_sum[n];
        double a_1 = (x->load[n] - force_1) * x->inverse_mass[n] - thrust;
        double slope = x->mass[n] * (x->joint_decay[n] * a_1 + x->joint_stiffness[n] * w_1 + x->share[n] * thrust_rate);
        int here = x->phase[n] == UNLOADING, apex = (v < 0.0) & (w_1 >= 0.0) & (w_1 - v > STILL_VELOCITY);
        int waits = here & ((slope > STILL_SLOPE) | (force_1 < 0.0) | apex), goes = here & !waits;
        x->d[n] = goes ? e_1 + x->q[n] + x->datum[n] : x->d[n], x->v[n] = goes ? w_1 : v;
        x->force[n] = goes ? force_1 : x->force[n], x->e[n] = goes ? e_1 : x->e[n], x->w[n] = goes ? w_1 : w;
        x->waits[n] = waits ? 1.0 : x->waits[n];
    }
}

static void step_loading(Lanes *restrict x, double sine, double cosine) {
    for (int n = 0; n < LANES; n++) {
        double h = x->h[n], d = x->d[n], v = x->v[n], force = x->force[n], w = x->w[n];
        double sinking = (x->load[n] - force) * x->inverse_mass[n], settled = x->compliance[n] * force, y = x->e[n] - settled;
        double d_free = d + h * v + x->half_square[n] * sinking - sine * x->travel_sine[n] - cosine * x->travel_cosine[n];
        double d_y = d + 0.5 * h * v + 0.25 * x->half_square[n] * sinking - sine * x->middle_sine[n] - cosine * x->middle_cosine[n];
        double v_free = v + h * sinking - sine * x->velocity_sine[n] - cosine * x->velocity_cosine[n];
        double known = settled + y * x->c1[n] + w * x->c2[n], known_y = settled + y * x->middle_c1[n] + w * x->middle_c2[n];
        double known_rate = w * x->c2_rate[n] - x->stiffness[n] * y * x->c2[n], rest = x->q[n] + x->datum[n];
        double right = d_free - rest - known, right_y = d_y - rest - known_y;
        double sigma = right * x->force_end[n] + right_y * x->force_middle[n];
        double kappa = right * x->bulge_end[n] + right_y * x->bulge_middle[n], start = sigma + kappa * h;
        double v_1 = v_free - sigma * x->v_slope[n] - kappa * x->v_bulge[n], force_1 = force + sigma * h;
        double w_1 = known_rate + start * x->step[n] - 2.0 * kappa * x->ramp[n];
        int here = x->phase[n] == LOADING, apex = (v < 0.0) & (v_1 >= 0.0) & (v_1 - v > STILL_VELOCITY);
        int ends = (v_1 < w_1 - STILL_VELOCITY) | (2.0 * sigma < -STILL_SLOPE);
        int waits = here & (ends | apex), goes = here & !waits;
        x->d[n] = goes ? d_free - sigma * x->d_slope[n] - kappa * x->d_bulge[n] : d, x->v[n] = goes ? v_1 : v;
        x->q[n] = goes ? x->q[n] + x->plastic[n] * (force_1 - force) : x->q[n], x->force[n] = goes ? force_1 : force;
        x->e[n] = goes ? known + start * x->ramp[n] - kappa * x->ramp_2[n] : x->e[n], x->w[n] = goes ? w_1 : w;
        x->waits[n] = waits ? 1.0 : x->waits[n];
    }
}

/* Revolutions of 128 samples of eight runs, all of constant amplitude from phase zero. */
void lanes(long revolutions, double *states, const double *constants, long constants_size, const double *sine,
           const double *cosine) {
    static const int state_size = UNSETTLED_STEPS + 1;
    Model models[LANES];
    Lanes x;
    Split split;
    long unsettled = 0;
    for (int n = 0; n < LANES; n++) {
        const double *own = constants + n * constants_size;
        Model m = {.h = own[STEP], .omega = own[OMEGA], .mass = own[MASS], .inverse_mass = 1.0 / own[MASS],
                   .load = own[STATIC_LOAD], .plastic = own[PLASTIC_COMPLIANCE], .two_pole = true,
                   .natural = own[NATURAL_FREQUENCY], .quality = own[QUALITY], .compliance = own[STATIC_COMPLIANCE]};
        models[n] = m;
        load_lane(&x, n, &m, own, states + n * state_size);
    }
    for (long r = 0; r < revolutions; r++)
        for (int j = 0; j < 128; j++) {
            int phases[3] = {0, 0, 0};
            for (int n = 0; n < LANES; n++)
                phases[(int)x.phase[n]]++;
            if (phases[LOADING])
                step_loading(&x, sine[j], cosine[j]);
            if (phases[UNLOADING])
                step_unloading(&x, sine[j], cosine[j]);
            if (phases[AIR])
                step_in_air(&x, sine[j], cosine[j]);
            double waiting = 0.0;
            for (int n = 0; n < LANES; n++)
                waiting += x.waits[n];
            for (int n = 0; waiting > 0.0 && n < LANES; n++)
                if (x.waits[n] > 0.0) {
                    State s = {x.d[n], x.v[n], x.force[n], x.e[n], x.w[n], x.q[n], x.datum[n]};
                    split.sine = sine[j], split.cosine = cosine[j], split.amplitude = x.amplitude[n];
                    Result whole = part(&models[n], &split, (int)x.phase[n], 0.0, models[n].h, 0.0, &s);
                    x.phase[n] = split_step(&models[n], &split, (int)x.phase[n], &s, whole, &unsettled);
                    x.d[n] = s.d, x.v[n] = s.v, x.force[n] = s.force, x.e[n] = s.e, x.w[n] = s.w, x.q[n] = s.q;
                    x.datum[n] = s.datum, x.waits[n] = 0.0, waiting -= 1.0;
                }
        }
    for (int n = 0; n < LANES; n++) {
        double *state = states + n * state_size;
        state[DEPTH] = x.d[n], state[VELOCITY] = x.v[n], state[FORCE] = x.force[n], state[SURFACE] = x.e[n];
        state[SURFACE_VELOCITY] = x.w[n], state[PLASTIC] = x.q[n], state[DATUM] = x.datum[n], state[PHASE] = x.phase[n];
    }
}
