void cyclic(void)
{
	v.cycles = v.cycles + 1;
	if (v.cycles % 1000 == 0) {
		v.setpoint = 100.0 - v.setpoint;
	}

	if (v.ramp < v.setpoint) {
		v.ramp = v.ramp + v.rate * v.dt;
		if (v.ramp > v.setpoint) {
			v.ramp = v.setpoint;
		}
	} else if (v.ramp > v.setpoint) {
		v.ramp = v.ramp - v.rate * v.dt;
		if (v.ramp < v.setpoint) {
			v.ramp = v.setpoint;
		}
	}

	v.error = v.ramp - v.actual;
	v.integral = v.integral + v.error * v.ki * v.dt;
	if (v.integral > v.integral_max) {
		v.integral = v.integral_max;
	} else if (v.integral < -v.integral_max) {
		v.integral = -v.integral_max;
	}
	v.derivative = (v.error - v.last) * v.kd / v.dt;
	v.last = v.error;
	v.out = v.kp * v.error + v.integral + v.derivative;

	v.limited = 1;
	if (v.out > v.out_max) {
		v.out = v.out_max;
	} else if (v.out < v.out_min) {
		v.out = v.out_min;
	} else {
		v.limited = 0;
	}

	v.actual = v.actual + (v.out - v.actual) * v.dt;
}
